#include "tools/study/named_files.h"

#include <yaml-cpp/yaml.h>

#include "engine/base/input.h"
#include "engine/base/plain_path.h"

namespace scree::study {

namespace {

namespace fs = std::filesystem;
using Kind = InputValue::Kind;

// A table may be a list, too.
bool names_file(const Key* key) {
  return key != nullptr && (key->type == KeyType::path || key->type == KeyType::table);
}

std::string in_folder(const fs::path& folder, const std::string& file) {
  return plain_path(folder / file).string();
}

// Whether there are any.
bool put_files_in(const fs::path& folder, const KeyNode& node, InputValue& value) {
  if (value.kind == Kind::scalar) {
    if (!names_file(node.key)) return false;
    value.text = in_folder(folder, value.text);
    return true;
  }
  bool any = false;
  const auto below = [&](const KeyNode* child, InputValue& one) {
    if (child != nullptr && put_files_in(folder, *child, one)) any = true;
  };
  for (InputValue& item : value.items) below(node.find("[]"), item);
  for (InputEntry& entry : value.entries) {
    const KeyNode* named = node.find(entry.name);
    below(named != nullptr ? named : node.find("*"), entry.value);
  }
  return any;
}

void write(const InputValue& value, YAML::Emitter& out) {
  switch (value.kind) {
    case Kind::empty:
      out << YAML::Null;
      break;
    case Kind::scalar:
      out << YAML::DoubleQuoted << value.text;
      break;
    case Kind::list:
      out << YAML::BeginSeq;
      for (const InputValue& item : value.items) write(item, out);
      out << YAML::EndSeq;
      break;
    case Kind::map:
      out << YAML::BeginMap;
      for (const InputEntry& entry : value.entries) {
        out << YAML::Key << YAML::DoubleQuoted << entry.name << YAML::Value;
        write(entry.value, out);
      }
      out << YAML::EndMap;
  }
}

std::string to_flow(const InputValue& value) {
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out.SetMapFormat(YAML::Flow);
  write(value, out);
  return out.c_str();
}

}  // namespace

std::string with_files_in(const fs::path& folder, const KeyNode& node, const std::string& value) {
  if (value == "null") return value;
  const bool is_flow = value.starts_with('{') || value.starts_with('[');
  try {
    // A path alone may be what YAML takes for something else, as `run #3`.
    InputValue parsed =
        is_flow ? parse_yaml(value, "") : InputValue{.kind = Kind::scalar, .where = {}, .text = value, .entries = {}};
    return put_files_in(folder, node, parsed) ? to_flow(parsed) : value;
  } catch (const InputError&) {
    return value;
  }
}

}  // namespace scree::study
