#include "tools/study/scene_key.h"

#include <algorithm>

#include "tools/scene/keys.h"

namespace scree::study {

namespace {

bool is_number(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

const KeyNode* step(const KeyNode& node, const std::string& part) {
  if (const KeyNode* named = node.find(part)) return named;
  const bool item = part.front() == '[' || is_number(part);
  return node.find(item ? "[]" : "*");
}

}  // namespace

const Key* scene_key(const std::string& path) {
  const KeyNode* node = &scene_keys().root();
  for (const std::string& part : split_path(path)) {
    node = part.empty() ? nullptr : step(*node, part);
    if (node == nullptr) return nullptr;
  }
  return node->key;
}

}  // namespace scree::study
