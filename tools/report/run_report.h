// The page of one run, from what it left in its directory.
#pragma once

#include <string>

#include "tools/run/run_files.h"

namespace scree::report {

enum class Pictures { none, still, animated };

// Throws InputError if there is no run in the directory.
std::string run_page(const run::RunFiles& files, Pictures pictures);

}  // namespace scree::report
