#include <cmath>

#include <fmt/format.h>

#include "tools/scene/keys.h"
#include "tools/scene/sections.h"

namespace scree {

namespace {

// A dozen frames show how heat spreads, and take less than a tenth of the stage that they are of (tools/bench/README.md); rows
// of probes.csv cost next to nothing.
constexpr int frames_by_default = 12;
constexpr int rows_by_default = 60;
constexpr double most_rows = 1e9;  // more are none that anyone waits for

CheckedEntry interval(const std::string& name, Checked value, const SourceLocation& where) {
  value.path = "output." + name;
  value.key = scene_keys().find(value.path);
  value.where = where;
  value.given = false;
  return {name, where, std::move(value)};
}

Checked part_of(Checked until, int parts) {
  until.numbers = {until.number() / parts};
  until.text = fmt::format("{} s", until.number());
  return until;
}

std::vector<CheckedEntry> intervals(const CheckedEntry& output, const Checked& until) {
  if (const Checked* frames = output.value.find("frames_every")) return {interval("every", *frames, output.where)};
  return {interval("every", part_of(until, rows_by_default), output.where),
          interval("frames_every", part_of(until, frames_by_default), output.where)};
}

}  // namespace

void fill_in_intervals(Checked& checked) {
  const Checked& until = checked.at("heat").at("until");
  if (!until.sound) return;
  for (CheckedEntry& section : checked.entries) {
    if (section.name != "output" || section.value.find("every") != nullptr) continue;
    add_entries(section.value, scene_keys(), intervals(section, until));
  }
}

void check_rows(const Checked& output, double until, Problems& problems) {
  const Checked& every = output.at("every");
  if (!every.sound || until <= most_rows * every.number()) return;
  problems.push_back(
      every.problem(fmt::format("{:g} s", every.number()),
                    fmt::format("must be at least {:g} s, for {:g} rows to heat.until", until / most_rows, most_rows)));
}

double read_frames_every(const Checked& output, Problems& problems) {
  const Checked* frames = output.find("frames_every");
  if (frames == nullptr || !frames->sound) return 0;
  const double every = output.at("every").number();
  const double ratio = frames->number() / every;
  if (every > 0 && (ratio < 0.5 || std::abs(ratio - std::round(ratio)) > 1e-9 * ratio)) {
    problems.push_back(frames->problem(fmt::format("{:g} s", frames->number()),
                                       fmt::format("must be a multiple of output.every, {:g} s", every)));
  }
  return frames->number();
}

std::vector<output::ProbeSpec> read_probes(const Checked& section, Problems& problems) {
  std::vector<output::ProbeSpec> probes;
  for (const CheckedEntry& entry : section.at("probes").entries) {
    output::ProbeSpec probe;
    probe.name = entry.name;
    probe.where = entry.where;
    const Checked& value = entry.value;
    probe.point = value.is_map ? value.at("point").vector() : value.vector();
    if (value.is_map) {
      probe.reach = value.at("reach").number();
      if (const Checked* exact = value.find("exact")) probe.exact = read_function(*exact, problems);
    }
    if (probe.name == "time") {
      problems.push_back({entry.where, value.path, "the first column of probes.csv", "must be another name", ""});
    }
    probes.push_back(std::move(probe));
  }
  return probes;
}

}  // namespace scree
