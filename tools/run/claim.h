// The directory that a run writes to, for itself: two runs into one would each take the other's files away.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tools/run/file_lock.h"
#include "tools/run/run_files.h"

namespace scree::run {

class Claim {
 public:
  // Makes the directory, with all above it, and its lock. Throws RunError, also where another run has it.
  explicit Claim(const RunFiles& files);

  // Takes away again what it has made.
  void undo();

 private:
  std::vector<std::filesystem::path> made_;  // deepest first
  std::optional<FileLock> lock_;
};

}  // namespace scree::run
