// What a run that goes on finds.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/check.h"

namespace scree::output {

// A run cannot go on with a file that is not as it left it: `key` says what the file is, `rule` what it must be.
InputError not_as_left(const std::string& key, const std::filesystem::path& file, const std::string& rule);

}  // namespace scree::output
