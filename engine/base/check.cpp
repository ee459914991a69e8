#include "engine/base/check.h"

#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

namespace scree {

namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

}  // namespace

std::string to_string(const SourceLocation& where) {
  if (where.line <= 0) return where.file;
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

std::string to_string(const Problem& problem) {
  std::string text = to_string(problem.where);
  if (!text.empty()) text += ": ";
  text += problem.key;
  if (!problem.value.empty()) text += fmt::format(" is {}", problem.value);
  if (!problem.rule.empty()) text += fmt::format(" ({})", problem.rule);
  if (!problem.suggestion.empty()) text += fmt::format(". {}", problem.suggestion);
  return text;
}

InputError::InputError(std::vector<Problem> problems) : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

void contract_failed(const char* kind, const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: %s: %s\n", file, line, kind, condition);
  std::abort();
}

}  // namespace scree
