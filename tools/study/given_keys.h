// The keys that a study gives values to, and that no value is lost under another.
#pragma once

#include <string>
#include <vector>

#include "engine/base/check.h"
#include "tools/study/scene_key.h"

namespace scree::study {

// A key as it stands in the study.
struct GivenKey {
  std::string text;  // as written; of `set` with its value
  ScenePath path;
  SourceLocation where;
};

// Keys that vary are given to a run one after the other, and after all of `set`: none of them may be another or lie inside
// another, nor hold one of `set`.
std::vector<Problem> overlaps(const std::vector<GivenKey>& varied, const std::vector<GivenKey>& set);

// Changes of `set` that take away what one before them has set, in the order of the study.
std::vector<Problem> repeated(const std::vector<GivenKey>& set);

}  // namespace scree::study
