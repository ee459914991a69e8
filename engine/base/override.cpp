// `--set key.path=value`.
#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "engine/base/input.h"

namespace scree {

namespace {

using Kind = InputValue::Kind;

[[noreturn]] void refuse(const std::string& path, const std::string& value, const std::string& rule) {
  Problem problem;
  problem.where = {"--set " + path, 0, 0};
  problem.key = path;
  problem.value = value;
  problem.rule = rule;
  throw InputError(std::move(problem));
}

// a.b[0].c -> a, b, 0, c
std::vector<std::string> segments(const std::string& path) {
  std::string plain;
  for (const char c : path) {
    if (c == '[') plain += '.';
    if (c != '[' && c != ']') plain += c;
  }
  std::vector<std::string> parts{""};
  for (const char c : plain) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<std::size_t> index_of(const std::string& segment) {
  std::size_t index = 0;
  const char* end = segment.data() + segment.size();
  const auto [stop, error] = std::from_chars(segment.data(), end, index);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return index;
}

// The value one step further down; made if a map lacks it.
InputValue& step_down(InputValue& value, const std::string& segment, const std::string& path) {
  if (value.kind == Kind::list) {
    const auto index = index_of(segment);
    if (!index || *index >= value.items.size()) {
      refuse(path, "not there", fmt::format("{} is no item of a list of {}, counted from 0", segment, value.items.size()));
    }
    return value.items[*index];
  }
  if (value.kind == Kind::empty) value.kind = Kind::map;
  if (value.kind != Kind::map) refuse(path, "not there", fmt::format("{} would be inside {}", segment, describe(value)));
  for (InputEntry& entry : value.entries) {
    if (entry.name == segment) return entry.value;
  }
  const SourceLocation where{"--set " + path, 0, 0};
  value.entries.push_back({segment, where, {}});
  value.entries.back().value.where = where;
  return value.entries.back().value;
}

void relocate(InputValue& value, const SourceLocation& where) {
  value.where = where;
  for (InputValue& item : value.items) relocate(item, where);
  for (InputEntry& entry : value.entries) {
    entry.where = where;
    relocate(entry.value, where);
  }
}

// Nothing happens if the key is not there.
void take_away(InputValue& value, const std::vector<std::string>& parts, std::size_t depth) {
  const std::string& segment = parts[depth];
  const bool last = depth + 1 == parts.size();
  if (value.kind == Kind::list) {
    const auto index = index_of(segment);
    if (!index || *index >= value.items.size()) return;
    if (!last) return take_away(value.items[*index], parts, depth + 1);
    value.items.erase(value.items.begin() + static_cast<std::ptrdiff_t>(*index));
    return;
  }
  const auto entry = std::find_if(value.entries.begin(), value.entries.end(),
                                  [&](const InputEntry& candidate) { return candidate.name == segment; });
  if (entry == value.entries.end()) return;
  if (!last) return take_away(entry->value, parts, depth + 1);
  value.entries.erase(entry);
}

}  // namespace

void apply_override(InputValue& root, const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string path = assignment.substr(0, equals);
  const std::vector<std::string> parts = segments(path);
  const bool blank = std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return part.empty(); });
  if (equals == std::string::npos || blank) {
    refuse(assignment, "not understood", "must be key.path=value");
  }
  const std::string text = assignment.substr(equals + 1);
  InputValue value = parse_yaml(text, "--set " + path);
  if (value.kind == Kind::empty) {
    const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
    if (!text.substr(begin).starts_with('~') && !text.substr(begin).starts_with("null"))
      refuse(path, begin == text.size() ? "empty" : text, "null takes a key away");
    return take_away(root, parts, 0);
  }

  relocate(value, {"--set " + path, 0, 0});
  InputValue* place = &root;
  for (const std::string& part : parts) place = &step_down(*place, part, path);
  *place = std::move(value);
}

}  // namespace scree
