#include "tools/study/summary_value.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace scree::study {

namespace {

using Json = nlohmann::json;

const Json nothing;

const Json& item(const Json& list, const std::string& name) {
  for (const Json& candidate : list) {
    if (candidate.is_object() && candidate.value("name", Json()) == name) return candidate;
  }
  std::size_t index = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool number = error == std::errc{} && stop == name.data() + name.size();
  return number && index < list.size() ? list[index] : nothing;
}

const Json& entry(const Json& json, const std::string& name) {
  if (json.is_array()) return item(json, name);
  return json.is_object() && json.contains(name) ? json[name] : nothing;
}

// A name in the summary may hold dots (a boundary's), so that the longest one that fits goes first.
const Json& descend(const Json& json, const std::string& path) {
  if (path.empty()) return json;
  for (std::size_t end = path.size(); end != std::string::npos && end > 0; end = path.rfind('.', end - 1)) {
    const Json& below = entry(json, path.substr(0, end));
    if (below.is_null()) continue;
    const Json& found = descend(below, end == path.size() ? "" : path.substr(end + 1));
    if (!found.is_null()) return found;
  }
  return nothing;
}

void add_leaves(const Json& json, const std::string& path, std::vector<std::string>& paths) {
  const auto below = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) add_leaves(value, below(name), paths);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      const bool named = json[i].is_object() && json[i].contains("name");
      add_leaves(json[i], below(named ? json[i]["name"].get<std::string>() : fmt::format("{}", i)), paths);
    }
  } else {
    paths.push_back(path);
  }
}

}  // namespace

const Json& value_at(const Json& summary, const std::string& path) {
  return descend(summary, path);
}

std::vector<std::string> leaves(const Json& summary) {
  std::vector<std::string> paths;
  add_leaves(summary, "", paths);
  return paths;
}

}  // namespace scree::study
