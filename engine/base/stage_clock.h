// What a stage of a run costs.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace scree {

struct StageCost {
  std::string name;
  double wall_seconds = 0;
  std::int64_t peak_memory_bytes = 0;  // of the whole process while the stage ran, earlier stages' results included
};

// Runs from its construction. Stages follow each other: starting one forgets the peak of the one before, so two clocks at
// the same time would share the later one's peak.
class StageClock {
 public:
  explicit StageClock(std::string name);

  // What is done between these is another clock's.
  void pause();
  void resume();

  [[nodiscard]] StageCost read() const;

 private:
  std::string name_;
  StageCost before_;  // the last pause
  std::chrono::steady_clock::time_point start_;
};

}  // namespace scree
