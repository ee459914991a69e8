// From the files of the runs to the table of the study.
#pragma once

#include "tools/study/plan.h"
#include "tools/study/study_files.h"
#include "tools/study/table.h"

namespace scree::study {

// A row per run: run, point, what varies, what is reported, status, reason, wall_seconds, peak_memory_bytes, directory.
Table gather(const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files);

// Paths that are in no summary of a run that ended, with what was probably meant: one sentence each.
std::vector<std::string> paths_not_found(const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files);

// How the runs stand.
struct Standing {
  std::size_t complete = 0;
  std::size_t unsound = 0;  // ended otherwise
  std::size_t open = 0;     // not ended
};
Standing standing_of(const Table& table);

}  // namespace scree::study
