#include "tools/study/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace scree::study {

namespace {

constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();

std::int64_t of_machine() {
  std::ifstream info("/proc/meminfo");
  for (std::string word; info >> word;) {
    std::int64_t kibibytes = 0;
    if (word == "MemAvailable:" && info >> kibibytes) return kibibytes * 1024;
  }
  return unlimited;
}

// "max" stands for no limit, and reads as no number.
std::int64_t of_control_group() {
  std::int64_t limit = 0;
  std::ifstream file("/sys/fs/cgroup/memory.max");
  return file >> limit ? limit : unlimited;
}

}  // namespace

std::int64_t available_memory() {
  return std::min(of_machine(), of_control_group());
}

}  // namespace scree::study
