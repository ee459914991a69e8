#include "tools/run/output_place.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/check.h"

namespace scree::run {

void check_output_place(const std::string& option, const std::filesystem::path& file, const std::vector<std::string>& endings) {
  Problem problem;
  problem.key = option;
  problem.value = file.string();
  const bool ends = std::find(endings.begin(), endings.end(), file.extension().string()) != endings.end();
  std::error_code ignored;
  if (!ends) {
    problem.rule = fmt::format("must end in {}", fmt::join(endings, " or "));
  } else if (!std::filesystem::is_directory(std::filesystem::absolute(file).parent_path(), ignored)) {
    problem.rule = "must be in a folder that exists";
  } else {
    return;
  }
  throw InputError(problem);
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  if (error == std::errc::not_a_directory) {
    throw InputError(Problem{{}, "--out", folder.string(), "must be a folder; a file has its name, or one above it", ""});
  }
  throw RunError(fmt::format("{}: cannot be created ({}). Choose another --out", folder.string(), error.message()));
}

}  // namespace scree::run
