// A formula that a user writes, such as `25 + 100*x`: muParser reads and evaluates it.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace scree {

// Why a text is no formula, and where in it.
class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(const std::string& reason, std::string suggestion)
      : std::runtime_error(reason), suggestion_(std::move(suggestion)) {}

  [[nodiscard]] const std::string& suggestion() const { return suggestion_; }

 private:
  std::string suggestion_;
};

// Copies share the formula, and so do all of the same text while there is one: to parse it takes muParser some tenths of a
// millisecond, and probes often name the same. It keeps its variables and its stack in the parser, so evaluations take turns.
class Expression {
 public:
  // Throws ExpressionError. `pi` and muParser's functions are known beside the variables.
  Expression(const std::string& text, const std::vector<std::string>& variables);

  // At values of the variables, in their order. May be infinite or no number, for muParser divides by zero without a word.
  double operator()(std::span<const double> values) const;

  // Whether the value depends on this variable as far as the text tells.
  [[nodiscard]] bool uses(const std::string& variable) const;

  // Whether it compares, chooses or rounds: only then may its value jump.
  [[nodiscard]] bool may_jump() const;

 private:
  struct Parser;
  std::shared_ptr<Parser> parser_;
};

}  // namespace scree
