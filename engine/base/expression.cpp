#include "engine/base/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include "engine/base/check.h"
#include "engine/base/nearest.h"

namespace scree {

struct Expression::Parser {
  Parser(const std::string& text, const std::vector<std::string>& variables);

  mu::Parser formula;
  std::vector<double> values;  // of the variables; the formula holds their addresses
  std::vector<std::string> used;
  bool may_jump = false;
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

// The first name in the text that nobody knows; muParser stumbles over an unknown function only at its parenthesis.
struct Word {
  std::string text;
  std::size_t begin = 0;
};
std::optional<Word> unknown_name(const std::string& text, const std::vector<std::string>& known) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_letter(text[i])) continue;
    std::size_t end = i;
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    const bool exponent = i > 0 && is_digit(text[i - 1]);  // 1e3
    Word word{text.substr(i, end - i), i};
    if (!exponent && word.text.front() != '_' && std::find(known.begin(), known.end(), word.text) == known.end()) return word;
    i = end;
  }
  return std::nullopt;
}

ExpressionError explain(const mu::ParserError& error, const mu::Parser& formula, const std::string& text,
                        const std::vector<std::string>& variables) {
  const std::vector<std::string> known = known_names(formula, variables);
  if (const auto word = unknown_name(text, known)) {
    return {fmt::format("{} at its character {} is no known name; known are {}", word->text, word->begin + 1,
                        fmt::join(known, ", ")),
            suggest(word->text, known)};
  }
  // muParser appends a blank.
  const int character = std::clamp(error.GetPos() + 1, 1, static_cast<int>(text.size()) + 1);
  return {fmt::format("{} at its character {}", reason(error), character), ""};
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

// By muParser's operators and functions; division by zero is no value.
bool holds_a_jump(const std::string& text) {
  const bool compares = text.find_first_of("<>=?&|") != std::string::npos;  // with != and :, too
  return compares || text.find("sign") != std::string::npos || text.find("rint") != std::string::npos ||
         text.find("atan2") != std::string::npos;
}

// What solutions of the heat equation are made of, and muParser lacks.
double error_function(double x) {
  return std::erf(x);
}
double complementary_error_function(double x) {
  return std::erfc(x);
}

}  // namespace

Expression::Parser::Parser(const std::string& text, const std::vector<std::string>& variables) : values(variables.size(), 0) {
  refuse_assignment(text);
  try {
    formula.DefineConst("pi", std::numbers::pi);
    formula.DefineFun("erf", error_function);
    formula.DefineFun("erfc", complementary_error_function);
    for (std::size_t i = 0; i < variables.size(); ++i) formula.DefineVar(variables[i], &values[i]);
    formula.SetExpr(text);
    for (const auto& entry : formula.GetUsedVar()) used.push_back(entry.first);
    may_jump = holds_a_jump(text);
    formula.Eval();
  } catch (const mu::ParserError& error) {
    throw explain(error, formula, text, variables);
  }
  if (formula.GetNumResults() != 1) throw ExpressionError("it has more than one value", "Write one formula without a comma");
}

Expression::Expression(const std::string& text, const std::vector<std::string>& variables) {
  static std::mutex turn;
  static std::map<std::pair<std::string, std::vector<std::string>>, std::weak_ptr<Parser>> in_use;
  const std::lock_guard lock(turn);
  const auto found = in_use.find({text, variables});
  if (found != in_use.end()) parser_ = found->second.lock();
  if (parser_) return;
  std::erase_if(in_use, [](const auto& entry) { return entry.second.expired(); });
  parser_ = std::make_shared<Parser>(text, variables);
  in_use[{text, variables}] = parser_;
}

double Expression::operator()(std::span<const double> values) const {
  SCREE_EXPECT(values.size() == parser_->values.size());
  const std::lock_guard lock(parser_->turn);
  std::copy(values.begin(), values.end(), parser_->values.begin());
  return parser_->formula.Eval();
}

bool Expression::may_jump() const {
  return parser_->may_jump;
}

bool Expression::uses(const std::string& variable) const {
  return std::find(parser_->used.begin(), parser_->used.end(), variable) != parser_->used.end();
}

}  // namespace scree
