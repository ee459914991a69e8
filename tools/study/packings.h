// Settled packings, shared by the runs of a study.
#pragma once

#include "tools/study/plan.h"
#include "tools/study/study_files.h"

namespace scree::study {

// Gives a run the packing of its kind, if it has none yet.
void take_packing(const StudyFiles& files, const PlannedRun& run);

// Puts up the packing that a run has made, for others of its kind. False if it has not made any yet.
bool publish_packing(const StudyFiles& files, const PlannedRun& run);

// Puts up what runs have made that ended, or still go on, after whoever started them was killed.
void publish_packings(const StudyFiles& files, const std::vector<PlannedRun>& runs);

}  // namespace scree::study
