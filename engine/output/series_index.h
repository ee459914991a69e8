// The .pvd of a series: which frame belongs to which time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scree::output {

struct SeriesEntry {
  double time = 0;   // [s]
  std::string file;  // relative to the .pvd's folder
};

// Throws RunError if the file is not a .pvd, or names a frame that is not there.
std::vector<SeriesEntry> read_index(const std::filesystem::path& index);

void write_index(const std::filesystem::path& index, const std::vector<SeriesEntry>& entries);

}  // namespace scree::output
