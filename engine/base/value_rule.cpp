#include "engine/base/value_rule.h"

#include <fmt/format.h>

namespace scree {

std::string ValueRule::words() const {
  const std::string limits = range.words().empty() ? "a number" : range.words();
  return quantity.unit.empty() ? limits : fmt::format("{}, {}", limits, quantity.unit);
}

Problem ValueRule::problem(std::string value, std::string rule, std::string suggestion) const {
  Problem result;
  result.where = where;
  result.key = key;
  result.value = std::move(value);
  result.rule = std::move(rule);
  result.suggestion = std::move(suggestion);
  return result;
}

}  // namespace scree
