// A study file to a Study.
#pragma once

#include "tools/study/study.h"

namespace scree::study {

// Throws InputError with everything that is wrong with the file itself. Whether its values suit the scene shows when the runs
// are planned.
Study read_study(const std::filesystem::path& file);

}  // namespace scree::study
