#include "engine/output/not_as_left.h"

namespace scree::output {

InputError not_as_left(const std::string& key, const std::filesystem::path& file, const std::string& rule) {
  Problem problem;
  problem.key = key;
  problem.value = file.string();
  problem.rule = rule;
  problem.suggestion = "Run the scene again";
  return InputError(problem);
}

}  // namespace scree::output
