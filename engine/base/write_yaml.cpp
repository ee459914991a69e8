// The effective input: what was written, and the defaults for what was not.
#include <yaml-cpp/yaml.h>

#include "engine/base/checked_input.h"

namespace scree {

namespace {

void write_pairs(const std::vector<std::string>& texts, YAML::Emitter& out) {
  out << YAML::Flow << YAML::BeginSeq;
  for (std::size_t i = 0; i + 1 < texts.size(); i += 2) {
    out << YAML::Flow << YAML::BeginSeq << texts[i] << texts[i + 1] << YAML::EndSeq;
  }
  out << YAML::EndSeq;
}

void write_leaf(const Checked& checked, YAML::Emitter& out) {
  if (checked.key->type == KeyType::table && !checked.texts.empty()) return write_pairs(checked.texts, out);
  if (!checked.texts.empty()) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const std::string& text : checked.texts) out << text;
    out << YAML::EndSeq;
    return;
  }
  const KeyType type = checked.key->type;
  const bool free = type == KeyType::text || type == KeyType::path || type == KeyType::table;
  if (free) out << YAML::DoubleQuoted;
  out << checked.text;
}

void write_value(const Checked& checked, YAML::Emitter& out) {
  if (checked.is_map) {
    if (checked.entries.empty()) out << YAML::Flow;
    out << YAML::BeginMap;
    for (const CheckedEntry& entry : checked.entries) {
      out << YAML::Key << entry.name << YAML::Value;
      write_value(entry.value, out);
    }
    out << YAML::EndMap;
  } else if (checked.key->type == KeyType::list) {
    if (checked.items.empty()) out << YAML::Flow;
    out << YAML::BeginSeq;
    for (const Checked& item : checked.items) write_value(item, out);
    out << YAML::EndSeq;
  } else {
    write_leaf(checked, out);
  }
}

}  // namespace

std::string to_yaml(const Checked& checked) {
  YAML::Emitter out;
  write_value(checked, out);
  return std::string(out.c_str()) + "\n";
}

}  // namespace scree
