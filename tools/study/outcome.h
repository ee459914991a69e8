// What came of a run, from the files it and its starter left.
#pragma once

#include <nlohmann/json.hpp>

#include "tools/run/child_process.h"
#include "tools/study/study_files.h"

namespace scree::study {

struct Outcome {
  std::string status = "pending";  // or as summary.json has it, or crashed
  std::string reason;              // why it is not complete
  double wall_seconds = 0;         // of its last start, or of its stages if nobody saw its end; 0 before it
  double peak_memory_bytes = 0;
  nlohmann::json summary;  // null if there is none

  // Another start would bring the same.
  [[nodiscard]] bool is_final() const;
};

Outcome read_outcome(const StudyFiles& files, const std::string& run);

// Keeps how a run's process ended.
void write_outcome(const StudyFiles& files, const std::string& run, const run::ChildEnd& end);

// Keeps that a run was not started, and why.
void write_refusal(const StudyFiles& files, const std::string& run, const std::string& reason);

}  // namespace scree::study
