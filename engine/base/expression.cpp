#include "engine/base/expression.h"

#include <algorithm>
#include <mutex>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include "engine/base/check.h"
#include "engine/base/nearest.h"

namespace scree {

struct Expression::Parser {
  mu::Parser formula;
  std::vector<double> values;  // of the variables; the formula holds their addresses
  std::vector<std::string> used;
  std::mutex turn;
};

namespace {

// Variables first, then what muParser brings.
std::vector<std::string> known_names(const mu::Parser& formula, const std::vector<std::string>& variables) {
  std::vector<std::string> names = variables;
  for (const auto& entry : formula.GetConst()) {
    if (entry.first.front() != '_') names.push_back(entry.first);
  }
  for (const auto& entry : formula.GetFunDef()) names.push_back(entry.first);
  return names;
}

// muParser's message without its position, which counts from 0 here and is left out there.
std::string reason(const mu::ParserError& error) {
  std::string text = error.GetMsg();
  for (const char* lead : {" at position", " at expression position", " found at"}) {
    const auto place = text.find(lead);
    if (place != std::string::npos) text.resize(place);
  }
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

ExpressionError explain(const mu::ParserError& error, const mu::Parser& formula, const std::vector<std::string>& variables) {
  const int character = std::max(error.GetPos(), 0) + 1;
  if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN) {
    return {fmt::format("{} at its character {}", reason(error), character), ""};
  }
  const std::vector<std::string> known = known_names(formula, variables);
  return {
      fmt::format("{} at its character {} is no known name; known are {}", error.GetToken(), character, fmt::join(known, ", ")),
      suggest(error.GetToken(), known)};
}

// muParser would take `x = 3` for an assignment.
void refuse_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool compares = i > 0 && std::string_view("=<>!").find(text[i - 1]) != std::string_view::npos;
    const bool doubled = i + 1 < text.size() && text[i + 1] == '=';
    if (!compares && !doubled) throw ExpressionError(fmt::format("= at its character {} assigns", i + 1), "Did you mean ==?");
  }
}

}  // namespace

Expression::Expression(const std::string& text, const std::vector<std::string>& variables)
    : parser_(std::make_shared<Parser>()) {
  refuse_assignment(text);
  mu::Parser& formula = parser_->formula;
  parser_->values.assign(variables.size(), 0);
  try {
    formula.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < variables.size(); ++i) formula.DefineVar(variables[i], &parser_->values[i]);
    formula.SetExpr(text);
    for (const auto& entry : formula.GetUsedVar()) parser_->used.push_back(entry.first);
    formula.Eval();
  } catch (const mu::ParserError& error) {
    throw explain(error, formula, variables);
  }
  if (formula.GetNumResults() != 1) throw ExpressionError("it has more than one value", "Write one formula without a comma");
}

double Expression::operator()(std::span<const double> values) const {
  SCREE_EXPECT(values.size() == parser_->values.size());
  const std::lock_guard lock(parser_->turn);
  std::copy(values.begin(), values.end(), parser_->values.begin());
  return parser_->formula.Eval();
}

bool Expression::uses(const std::string& variable) const {
  return std::find(parser_->used.begin(), parser_->used.end(), variable) != parser_->used.end();
}

}  // namespace scree
