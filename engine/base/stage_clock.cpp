#include "engine/base/stage_clock.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include <sys/resource.h>

namespace scree {

namespace {

// Linux sets the high-water mark VmHWM back to the present size when 5 is written here (proc(5), since Linux 4.0). Where that
// is not allowed, the mark stays that of the process, which is still an upper bound.
void forget_peak() {
  std::ofstream clear("/proc/self/clear_refs");
  clear << 5 << std::flush;
}

std::int64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::int64_t kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

StageClock::StageClock(std::string name) : name_(std::move(name)), start_(std::chrono::steady_clock::now()) {
  forget_peak();
}

void StageClock::pause() {
  before_ = read();
}

void StageClock::resume() {
  start_ = std::chrono::steady_clock::now();
  forget_peak();
}

StageCost StageClock::read() const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  return {name_, before_.wall_seconds + elapsed.count(), std::max(before_.peak_memory_bytes, peak_memory())};
}

}  // namespace scree
