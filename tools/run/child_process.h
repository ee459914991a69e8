// Runs this very command in a process of its own, so that one run's memory, time and end are its own.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::run {

struct ChildEnd {
  int exit_status = 0;  // as a shell has it: 128 and the signal's number for one that a signal ended
  double wall_seconds = 0;
  std::int64_t peak_memory_bytes = 0;
};

// `scree ARGUMENTS`, its standard output and error to a log.
class ChildProcess {
 public:
  // Throws RunError if it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);

  // How it ended; nothing as long as it runs.
  [[nodiscard]] std::optional<ChildEnd> poll();
  ChildEnd wait();

  // Asks it to end at its next safe point.
  void interrupt() const;

 private:
  std::optional<ChildEnd> collect(int options);

  pid_t process_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace scree::run
