#include "engine/output/series.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/output/not_as_left.h"

namespace scree::output {

namespace fs = std::filesystem;

namespace {

constexpr double rounding = 1e-9;  // of a time

// Removes all frames of a series but those in `kept`, and what an interrupted write left behind.
void remove_frames(const fs::path& folder, const std::string& name, const std::set<fs::path>& kept) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool unfinished = entry.path().filename().string().starts_with(".part-" + name + "_");
    if ((is_frame(entry.path(), name) || unfinished) && !kept.contains(entry.path())) fs::remove(entry.path());
  }
}

std::vector<SeriesEntry> earlier_entries(const fs::path& index) {
  try {
    return read_index(index);
  } catch (const RunError& error) {
    throw not_as_left("series", index, fmt::format("must be the series that the run has left; {}", error.what()));
  }
}

}  // namespace

bool is_frame(const fs::path& file, const std::string& name) {
  return file.filename().string().starts_with(name + "_") && file.extension() == ".vtu";
}

void remove_series(const fs::path& directory, const std::string& name) {
  fs::remove(directory / (name + ".pvd"));
  if (!fs::is_directory(directory / name)) return;
  remove_frames(directory / name, name, {});
  std::error_code not_empty;
  fs::remove(directory / name, not_empty);
}

Series::Series(fs::path directory, std::string name, std::optional<double> keep_until)
    : directory_(std::move(directory)), index_(directory_ / (name + ".pvd")), name_(std::move(name)) {
  try {
    fs::create_directories(directory_ / name_);
    remove_unfinished(index_);
    std::set<fs::path> kept;
    if (keep_until) {
      const double latest = *keep_until * (1 + rounding);
      for (SeriesEntry& entry : earlier_entries(index_)) {
        if (entry.time > latest) continue;
        kept.insert(directory_ / entry.file);
        entries_.push_back(std::move(entry));
      }
      if (entries_.empty() || entries_.back().time < *keep_until * (1 - rounding)) {
        throw not_as_left("series", index_, fmt::format("must have a frame at {} s, to go on with the next one", *keep_until));
      }
    }
    // The index goes first, so that it never names a file that is gone.
    if (entries_.empty()) {
      fs::remove(index_);
    } else {
      write_index(index_, entries_);
    }
    remove_frames(directory_ / name_, name_, kept);
  } catch (const fs::filesystem_error& error) {
    throw RunError(
        fmt::format("{}: the series could not be started ({}). Choose another --out", index_.string(), error.code().message()));
  }
}

void Series::share(const Grid& grid, const std::vector<Array>& cells) {
  shared_ = encoded(grid, cells);
}

void Series::write(const Frame& frame) {
  append(frame, shared_);
}

void Series::write(const Grid& grid, const Frame& frame) {
  append(frame, encoded(grid, {}));
}

void Series::add(const Frame& frame) {
  add(frame, shared_);
}

void Series::name_frames() {
  write_index(index_, entries_);
}

void Series::add(const Frame& frame, const EncodedGrid& grid) {
  SCREE_EXPECT(entries_.empty() || frame.time > entries_.back().time);
  SeriesEntry entry{frame.time, fmt::format("{0}/{0}_{1:06}.vtu", name_, entries_.size())};
  write_vtu(directory_ / entry.file, grid, frame, scratch_);
  entries_.push_back(std::move(entry));
}

void Series::append(const Frame& frame, const EncodedGrid& grid) {
  add(frame, grid);
  try {
    name_frames();
  } catch (...) {
    std::error_code ignored;
    fs::remove(directory_ / entries_.back().file, ignored);
    entries_.pop_back();
    throw;
  }
}

}  // namespace scree::output
