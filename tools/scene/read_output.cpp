#include <cmath>

#include <fmt/format.h>

#include "tools/scene/keys.h"
#include "tools/scene/sections.h"

namespace scree {

// So many frames show how heat spreads, and take less than a tenth of the stage that they are of (tools/bench/README.md).
constexpr int intervals_by_default = 20;

void fill_in_interval(Checked& checked) {
  const Checked& until = checked.at("heat").at("until");
  if (!until.sound) return;
  for (CheckedEntry& section : checked.entries) {
    Checked& output = section.value;
    if (section.name != "output" || output.find("every") != nullptr) continue;
    const Checked* frames = output.find("frames_every");
    Checked every = frames == nullptr ? until : *frames;
    every.key = scene_keys().find("output.every");
    every.path = "output.every";
    every.given = false;
    if (frames == nullptr) {
      every.numbers = {until.number() / intervals_by_default};
      every.text = fmt::format("{} s", every.number());
    }
    output.entries.push_back({"every", section.where, std::move(every)});
  }
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
