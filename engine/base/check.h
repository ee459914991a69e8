// Two kinds of wrong. A programmer's: SCREE_EXPECT and SCREE_ENSURE, on in debug and sanitizer builds.
// A user's: InputError for what the scene or a file says, RunError for what a run could not do.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace scree {

// Where in a file a value stands; line and column count from 1, 0 is "no particular place".
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

// "file:line:column", as far as it is known.
std::string to_string(const SourceLocation& where);

// One thing that is wrong with an input.
struct Problem {
  SourceLocation where;
  std::string key;         // full path, such as materials.ore.conductivity
  std::string value;       // as written
  std::string rule;        // what would be accepted, with its unit
  std::string suggestion;  // what to do about it
};

// "file:line:column: key is VALUE (rule). Suggestion"
std::string to_string(const Problem& problem);

// Everything that is wrong with an input, found in one go. Exit status 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  explicit InputError(Problem problem);

  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

// A run that could not go on although its input was accepted: no convergence, a full disk. Exit status 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[noreturn]] void contract_failed(const char* kind, const char* condition, const char* file, int line);

}  // namespace scree

#ifdef SCREE_CHECKS
#define SCREE_CONTRACT_(kind, condition) \
  ((condition) ? void(0) : ::scree::contract_failed(kind, #condition, __FILE__, __LINE__))
#else
#define SCREE_CONTRACT_(kind, condition) (void(sizeof((condition) ? 1 : 0)))
#endif

#define SCREE_EXPECT(condition) SCREE_CONTRACT_("expected", condition)
#define SCREE_ENSURE(condition) SCREE_CONTRACT_("ensured", condition)
