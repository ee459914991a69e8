// Time series that ParaView opens: one .pvd and a compressed .vtu per time in a folder beside it.
//
// A file appears under its name only when it is whole, and the .pvd names only files that are, so whatever ends a
// run, the series is readable up to the last time that was named.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/series_index.h"
#include "engine/output/vtu_file.h"

namespace scree::output {

// Whether a file in the folder of a series has the name of a frame of it.
bool is_frame(const std::filesystem::path& file, const std::string& name);

// Removes a series, the .pvd first. Throws std::filesystem::filesystem_error.
void remove_series(const std::filesystem::path& directory, const std::string& name);

class Series {
 public:
  // A series `name`.pvd in `directory` with its data in `directory`/`name`/; the .pvd appears with the first frame. An older
  // series of that name is removed; with `keep_until` its frames up to and including the one at that time stay (a resumed
  // run), and if they are not there that is a RunError. Throws RunError if nothing can be written.
  Series(std::filesystem::path directory, std::string name, std::optional<double> keep_until = std::nullopt);

  // Appends a frame, later than the one before. Throws RunError (disk full) and leaves the series as it was before.
  // The same values give the same bytes.
  void write(const Grid& grid, const Frame& frame);

  // What the following frames share, beside their own arrays: encoded here, once and for all.
  void share(const Grid& grid, const std::vector<Array>& cells);

  // Appends a frame of what is shared.
  void write(const Frame& frame);

  // The same, but the .pvd names it from the next call of name_frames() on, which is worth it where frames follow each other
  // fast: a file of the .pvd's size costs about a sixth of a frame.
  void add(const Frame& frame);
  void name_frames();

  [[nodiscard]] std::size_t frames() const { return entries_.size(); }

 private:
  std::filesystem::path directory_;
  std::filesystem::path index_;
  std::string name_;
  std::vector<SeriesEntry> entries_;
  EncodedGrid shared_;
  EncodedArrays scratch_;

  void add(const Frame& frame, const EncodedGrid& grid);
  void append(const Frame& frame, const EncodedGrid& grid);
};

}  // namespace scree::output
