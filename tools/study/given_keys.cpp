#include "tools/study/given_keys.h"

#include <fmt/format.h>

namespace scree::study {

namespace {

Problem problem_of(const GivenKey& key, std::string rule) {
  return {key.where, key.text, "varied", std::move(rule), "Take one of the two out"};
}

}  // namespace

std::vector<Problem> overlaps(const std::vector<GivenKey>& varied, const std::vector<GivenKey>& set) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < varied.size(); ++i) {
    const GivenKey& key = varied[i];
    for (std::size_t j = 0; j < i; ++j) {
      const GivenKey& other = varied[j];
      const bool inside = other.path.holds(key.path);
      if (!inside && !key.path.holds(other.path)) continue;
      const bool same = inside && key.path.holds(other.path);
      problems.push_back(problem_of(key, fmt::format("must not {} {}, which is varied at line {}",
                                                     same     ? "be"
                                                     : inside ? "lie inside"
                                                              : "hold",
                                                     other.text, other.where.line)));
    }
    for (const GivenKey& change : set) {
      if (key.path.holds(change.path)) problems.push_back(problem_of(key, "must not be in set, too: " + change.text));
    }
  }
  return problems;
}

std::vector<Problem> repeated(const std::vector<GivenKey>& set) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!set[i].path.holds(set[j].path)) continue;
      const bool same = set[j].path.holds(set[i].path);
      problems.push_back(
          {set[i].where, fmt::format("set[{}]", i), set[i].text,
           fmt::format("must not {} {}, which is set before", same ? "give another value to" : "take away", set[j].text),
           "Take one of the two out"});
    }
  }
  return problems;
}

}  // namespace scree::study
