#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/output/series_index.h"
#include "engine/output/stored_field.h"

namespace scree::output {

namespace {

constexpr double same_time = 1e-9;  // of a series' last time

constexpr const char* name_a_run = "Name the output directory of a run with heat, a .pvd or a .vtu";

std::vector<SeriesEntry> frames_of(const StoredField& stored, const std::filesystem::path& index) {
  try {
    return read_index(index);
  } catch (const RunError& error) {
    throw InputError(stored.problem(stored.from.string(), error.what(), name_a_run));
  }
}

// The frame at the wanted time, or the last.
std::filesystem::path frame_of(const StoredField& stored, const std::filesystem::path& index) {
  const std::vector<SeriesEntry> entries = frames_of(stored, index);
  if (entries.empty()) throw InputError(stored.problem(index.string(), "must have a frame", ""));
  const SeriesEntry* chosen = &entries.back();
  if (stored.time) {
    const auto away = [&](const SeriesEntry& entry) { return std::abs(entry.time - *stored.time); };
    chosen = &*std::min_element(entries.begin(), entries.end(),
                                [&](const SeriesEntry& a, const SeriesEntry& b) { return away(a) < away(b); });
    if (away(*chosen) > same_time * std::max(*stored.time, entries.back().time)) {
      throw InputError(stored.problem(
          index.string(), fmt::format("has no frame at {:g} s; the nearest is at {:.10g} s", *stored.time, chosen->time),
          "Name one of its times in heat.initial.time"));
    }
  }
  return index.parent_path() / chosen->file;
}

}  // namespace

Problem StoredField::problem(const std::string& value, const std::string& rule, const std::string& suggestion) const {
  return {where, "heat.initial.from", value, rule, suggestion};
}

std::filesystem::path stored_frame(const StoredField& stored) {
  std::error_code ignored;  // what cannot be asked for is not there
  if (std::filesystem::is_directory(stored.from, ignored)) return frame_of(stored, stored.from / "heat.pvd");
  if (stored.from.extension() == ".pvd") return frame_of(stored, stored.from);
  if (stored.time) throw InputError(stored.problem(stored.from.string(), "is a single frame", "Leave heat.initial.time out"));
  if (!std::filesystem::is_regular_file(stored.from, ignored)) {
    throw InputError(stored.problem(stored.from.string(), "must be there", name_a_run));
  }
  return stored.from;
}

}  // namespace scree::output
