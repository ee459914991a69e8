// A folder of a test's own, gone afterwards: tests run side by side.
#pragma once

#include <filesystem>

#include "engine/base/scratch_folder.h"

namespace scree::test {

using TempFolder = ScratchFolder;

// One for the whole program, for what several tests share.
inline const std::filesystem::path& temp_folder() {
  static const TempFolder folder;
  return folder.path();
}

}  // namespace scree::test
