#include "engine/base/input.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>
#include <nlohmann/json.hpp>

namespace scree {

namespace {

// yaml-cpp counts from 0 and has -1 for "nowhere".
SourceLocation location(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return {file, 0, 0};
  return {file, mark.line + 1, mark.column + 1};
}

[[noreturn]] void refuse(const SourceLocation& where, const std::string& value, const std::string& rule,
                         const std::string& suggestion) {
  throw InputError(Problem{where, "the file", value, rule, suggestion});
}

// A pipe is read to its end; a device may have none.
std::string whole_text(std::istream& stream, const std::filesystem::path& file) {
  constexpr std::size_t most = 256'000'000;
  std::string text;
  std::array<char, 1 << 16> some;
  while (stream.read(some.data(), some.size()) || stream.gcount() > 0) {
    text.append(some.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most) refuse({file.string(), 0, 0}, "not readable", "more than 256 MB", "Name a file of text");
  }
  return text;
}

// What JSON takes, which all that is said of a run is written in.
bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

// For a line that YAML does not take.
std::string hint_for(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string here;
  for (int i = 0; i <= line; ++i) std::getline(lines, here);
  const std::string indentation = here.substr(0, here.find_first_not_of(" \t"));
  return indentation.find('\t') == std::string::npos ? "" : "Indent with spaces: YAML takes no tabs there";
}

// Turns nodes into data. Aliases are copied, so that a list holding itself would be endless and nested aliases grow without
// bound; no scene comes near these limits.
class Converter {
 public:
  explicit Converter(std::string file) : file_(std::move(file)) {}

  InputValue convert(const YAML::Node& node, const SourceLocation& parent, int depth) {
    InputValue value;
    value.where = location(file_, node.Mark());
    if (value.where.line == 0) value.where = parent;
    constexpr int deepest = 100;
    constexpr int most = 2'000'000;
    if (depth > deepest) refuse(value.where, "too deeply nested", "", "Look for an alias that holds itself");
    if (++count_ > most) {
      refuse(value.where, "too large", fmt::format("must have at most {} values", most),
             "Look for aliases within aliases; many places may come from a lattice, at random or from a mesh file");
    }
    if (node.IsScalar()) {
      value.kind = InputValue::Kind::scalar;
      value.text = text_of(node, value.where);
    } else if (node.IsSequence()) {
      value.kind = InputValue::Kind::list;
      for (const auto& item : node) value.items.push_back(convert(item, value.where, depth + 1));
    } else if (node.IsMap()) {
      value.kind = InputValue::Kind::map;
      for (const auto& pair : node) add_entry(value, pair.first, pair.second, depth);
    }
    return value;
  }

  std::vector<Problem> problems;

 private:
  static std::string text_of(const YAML::Node& node, const SourceLocation& where) {
    std::string text = node.Scalar();
    if (!is_utf8(text)) refuse(where, "no UTF-8 text", "", "Save it as UTF-8; a byte there belongs to another encoding");
    return text;
  }

  void add_entry(InputValue& map, const YAML::Node& name, const YAML::Node& node, int depth) {
    InputEntry entry;
    entry.where = location(file_, name.Mark());
    if (!name.IsScalar()) {
      problems.push_back({entry.where, "a key", "not a word", "", "Write a name before the colon"});
      return;
    }
    entry.name = text_of(name, entry.where);
    entry.value = convert(node, entry.where, depth + 1);
    if (entry.value.kind == InputValue::Kind::empty) entry.value.where = entry.where;  // else where the next thing is
    if (const InputValue* first = map.find(entry.name)) {
      const std::string rule = fmt::format("the first is at line {}", first->where.line);
      problems.push_back({entry.where, entry.name, "given twice", rule, "Keep one of them"});
      return;
    }
    map.entries.push_back(std::move(entry));
  }

  std::string file_;
  int count_ = 0;
};

// The last end of a character up to here, of UTF-8.
std::size_t characters_end(const std::string& text, std::size_t at) {
  while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) --at;
  return at;
}

}  // namespace

const InputValue* InputValue::find(std::string_view name) const {
  for (const InputEntry& entry : entries) {
    if (entry.name == name) return &entry.value;
  }
  return nullptr;
}

InputValue parse_yaml(const std::string& text, const std::string& name) {
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::Exception& error) {
    refuse(location(name, error.mark), "not YAML", error.msg, hint_for(text, error.mark.line));
  }
  if (documents.size() > 1) {
    refuse(location(name, documents[1].Mark()), "more than one YAML document", "", "Keep the part before the line ---");
  }
  if (documents.empty()) {
    InputValue nothing;
    nothing.where = {name, 1, 1};
    return nothing;
  }
  Converter converter(name);
  InputValue root = converter.convert(documents.front(), {name, 1, 1}, 0);
  if (!converter.problems.empty()) throw InputError(std::move(converter.problems));
  return root;
}

InputValue read_yaml(const std::filesystem::path& file) {
  std::error_code said_below;
  if (std::filesystem::is_directory(file, said_below)) refuse({file.string(), 0, 0}, "not readable", "a folder", "");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse({file.string(), 0, 0}, "not readable", std::strerror(errno), "");
  return parse_yaml(whole_text(stream, file), file.string());
}

std::string describe(const InputValue& value) {
  switch (value.kind) {
    case InputValue::Kind::empty:
      return "empty";
    case InputValue::Kind::list:
      return "a list";
    case InputValue::Kind::map:
      return "a map";
    case InputValue::Kind::scalar:
      break;
  }
  constexpr std::size_t longest = 60;
  if (value.text.empty()) return "\"\"";
  return value.text.size() <= longest ? value.text : value.text.substr(0, characters_end(value.text, longest)) + "...";
}

}  // namespace scree
