#include "tools/run/forget_run.h"

#include <vector>

namespace scree::run {

void forget_run(const RunFiles& files) {
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(files.directory)) left.push_back(entry.path());
  for (const std::filesystem::path& place : left) {
    if (place != files.packing()) std::filesystem::remove_all(place);
  }
}

}  // namespace scree::run
