// Files that the values of a study name.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/key_table.h"

namespace scree::study {

// The value of a scene's key as `--set` takes it, the files that it names, itself or deep within, in this folder where they are
// relative. A value that is not YAML stays as it is: the scene's check refuses it.
std::string with_files_in(const std::filesystem::path& folder, const KeyNode& node, const std::string& value);

}  // namespace scree::study
