#include "tools/study/scene_key.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "tools/scene/keys.h"

namespace scree::study {

namespace {

bool is_number(const std::string& part) {
  const bool digits = !part.empty() && std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits && (part == "0" || part.front() != '0');
}

bool is_name(const std::string& part) {
  return !part.empty() && part.find_first_of("[]*") == std::string::npos;
}

// 0 of 0 and of [0]; nothing for what is no item's number.
std::optional<std::string> item_number(const std::string& part) {
  const bool in_brackets = part.size() > 2 && part.front() == '[' && part.back() == ']';
  const std::string number = in_brackets ? part.substr(1, part.size() - 2) : part;
  return is_number(number) ? std::optional(number) : std::nullopt;
}

bool is_vector(const KeyNode& node) {
  return node.key != nullptr && node.key->count != Count::one;
}

// One of the paths of the table with the names and numbers that a user has written, as far as there are any.
std::string filled_in(const std::string& pattern, const std::vector<std::string>& written) {
  std::string path;
  const std::vector<std::string> parts = split_path(pattern);
  const bool alike = parts.size() == written.size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string own = alike ? written[i] : "";
    if (parts[i] == "[]") {
      path += fmt::format("[{}]", item_number(own).value_or("0"));
    } else {
      path += (i == 0 ? "" : ".") + (parts[i] == "*" ? (is_name(own) ? own : "NAME") : parts[i]);
    }
  }
  return path;
}

}  // namespace

bool ScenePath::holds(const ScenePath& other) const {
  return parts.size() <= other.parts.size() && std::equal(parts.begin(), parts.end(), other.parts.begin());
}

std::optional<ScenePath> scene_path(const std::string& path) {
  ScenePath found;
  const KeyNode* node = &scene_keys().root();
  bool is_one_of_a_vector = false;
  for (const std::string& part : split_path(path)) {
    if (is_one_of_a_vector) return std::nullopt;
    const KeyNode* items = node->find("[]");
    if (is_vector(*node) && item_number(part)) {
      is_one_of_a_vector = true;
      found.parts.push_back(*item_number(part));
      continue;
    }
    const auto number = items == nullptr ? std::nullopt : item_number(part);
    if (!number && !is_name(part)) return std::nullopt;
    const KeyNode* named = node->find(part);
    node = number ? items : named != nullptr ? named : node->find("*");
    if (node == nullptr) return std::nullopt;
    found.parts.push_back(number.value_or(part));
  }
  found.node = node;
  return node->key == nullptr ? std::nullopt : std::optional(found);
}

std::string suggest_path(const std::string& path) {
  std::vector<std::string> written = split_path(path);
  std::erase(written, "");
  std::vector<std::string> known;
  for (const Key& key : scene_keys().keys()) known.push_back(filled_in(key.path, written));
  const auto close = nearest(path, known);
  return close ? fmt::format("Did you mean {}?", *close) : "`scree keys` lists them all";
}

}  // namespace scree::study
