#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/key_reference.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

// As is_plain_name().
constexpr const char* name_pattern = "^[A-Za-z_][A-Za-z0-9_-]*$";
// A number, a unit behind it; whether the unit fits is for `scree check` to say.
constexpr const char* quantity_pattern = R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*(1/|[^0-9\s.+-]).*$)";

void add_range(const Range& range, Json& schema) {
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
}

Json number_schema(const Key& key) {
  Json number{{"type", key.type == KeyType::integer ? "integer" : "number"}};
  add_range(key.range, number);
  if (key.type == KeyType::integer) return number;
  return Json{{"anyOf", Json::array({number, Json{{"type", "string"}, {"pattern", quantity_pattern}}})}};
}

// A file's name, or pairs.
Json table_schema(const Key& key) {
  Key argument;
  argument.type = KeyType::quantity;
  argument.quantity = argument_of(key);
  Key value = key;
  value.type = KeyType::quantity;
  const Json pair{{"type", "array"},
                  {"prefixItems", Json::array({number_schema(argument), number_schema(value)})},
                  {"minItems", 2},
                  {"maxItems", 2}};
  const Json pairs{{"type", "array"}, {"items", pair}, {"minItems", 1}};
  return Json{{"anyOf", Json::array({Json{{"type", "string"}}, pairs})}};
}

Json leaf_schema(const Key& key) {
  switch (key.type) {
    case KeyType::quantity:
    case KeyType::integer: {
      if (key.count == Count::one) return number_schema(key);
      const bool four = key.count == Count::four;
      Json list{{"type", "array"}, {"items", number_schema(key)}, {"minItems", four ? 4 : 2}, {"maxItems", four ? 4 : 3}};
      if (key.count == Count::one_or_per_dimension) return Json{{"anyOf", Json::array({number_schema(key), list})}};
      return list;
    }
    case KeyType::table:
      return table_schema(key);
    case KeyType::flag:
      return Json{{"type", "boolean"}};
    case KeyType::word:
      // A word that looks like a number is one to a YAML editor.
      if (key.words.front().find_first_not_of("0123456789") == std::string::npos) {
        Json numbers = Json::array();
        for (const std::string& word : key.words) numbers.push_back(std::stoi(word));
        return Json{{"enum", numbers}};
      }
      if (key.words == std::vector<std::string>{"true"}) return Json{{"enum", Json::array({true})}};
      return Json{{"enum", key.words}};
    case KeyType::name:  // of a body, but also of a surface in a mesh's file, which may hold anything
    case KeyType::text:
      return Json{{"type", Json::array({"string", "number"})}};  // a title or a formula that is one number
    default:
      return Json{{"type", "string"}};
  }
}

std::string description(const Key& key) {
  std::string text = key.meaning;
  const std::string rule = rule_words(key, 0);
  if (!rule.empty()) text += fmt::format(" It {}.", rule);
  for (const Condition& condition : key.only) text += fmt::format(" Only {}.", condition.words());
  if (!key.otherwise.empty()) text += fmt::format(" Default: {}.", key.otherwise);
  if (!key.fallback.empty()) text += fmt::format(" Default: {}.", key.fallback);
  return text;
}

Json node_schema(const KeyNode& node);

// `oneOf` for a choice that must be made, `not` two at once for one that may.
void add_choices(const KeyNode& node, Json& schema) {
  std::vector<std::pair<const Key*, std::vector<std::string>>> choices;
  for (const auto& [name, child] : node.children) {
    const Key* key = child->key;
    if (key->choice.empty()) continue;
    const auto same = [&](const auto& choice) { return choice.first->choice == key->choice; };
    auto place = std::find_if(choices.begin(), choices.end(), same);
    if (place == choices.end()) place = choices.insert(place, {key, {}});
    place->second.push_back(name);
  }
  for (const auto& [first, names] : choices) {
    Json one = Json::array();
    Json any = Json::array();
    for (const std::string& name : names) {
      one.push_back(Json{{"required", Json::array({name})}});
      any.push_back(Json{{"required", Json::array({name})}});
    }
    if (!first->required) one.push_back(Json{{"not", Json{{"anyOf", any}}}});
    schema["allOf"].push_back(Json{{"oneOf", one}});
  }
}

Json names_schema(const KeyNode& node, const KeyNode& any) {
  Json schema{{"type", "object"}};
  schema["propertyNames"] = Json{{"pattern", name_pattern}};
  schema["additionalProperties"] = node_schema(any);
  if (node.key->type == KeyType::names && node.key->range.low >= 1) schema["minProperties"] = 1;
  return schema;
}

Json keys_schema(const KeyNode& node) {
  Json schema{{"type", "object"}};
  schema["properties"] = Json::object();
  Json required = Json::array();
  for (const auto& [name, child] : node.children) {
    if (name == "*") continue;
    schema["properties"][name] = node_schema(*child);
    const bool always = child->key->required && child->key->choice.empty() && child->key->only.empty();
    if (always) required.push_back(name);
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  add_choices(node, schema);
  return schema;
}

Json map_schema(const KeyNode& node) {
  const KeyNode* any = node.find("*");
  if (any == nullptr) return keys_schema(node);
  if (node.children.size() == 1) return names_schema(node, *any);
  return Json{{"anyOf", Json::array({names_schema(node, *any), keys_schema(node)})}};
}

Json node_schema(const KeyNode& node) {
  const Key& key = *node.key;
  Json schema;
  if (key.type == KeyType::list) {
    schema = Json{{"type", "array"}, {"items", node_schema(*node.find("[]"))}};
    if (key.range.low >= 1) schema["minItems"] = 1;
  } else if (key.type == KeyType::section || key.type == KeyType::names) {
    schema = map_schema(node);
  } else if (node.children.empty()) {
    schema = leaf_schema(key);
  } else {
    schema = Json{{"anyOf", Json::array({leaf_schema(key), map_schema(node)})}};
  }
  schema["description"] = description(key);
  return schema;
}

}  // namespace

std::string key_schema(const KeyTable& table, const std::string& title) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(map_schema(table.root()));
  return schema.dump(2) + "\n";
}

}  // namespace scree
