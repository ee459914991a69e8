// Paths as one would write them.
#pragma once

#include <filesystem>

namespace scree {

// Without `.` and `..`, where that names the same file: behind a symbolic link to a folder `..` is not where the link lies.
std::filesystem::path plain_path(const std::filesystem::path& path);

}  // namespace scree
