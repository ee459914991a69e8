// Runs this very command in a process of its own, so that one run's memory and time are its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scree::accuracy {

struct ChildRun {
  int exit_status = 0;
  double wall_seconds = 0;
};

// `scree ARGUMENTS`, its standard output and error to `log`. Throws RunError if it cannot be started.
ChildRun run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log);

}  // namespace scree::accuracy
