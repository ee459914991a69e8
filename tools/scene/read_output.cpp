#include "tools/scene/sections.h"

namespace scree {

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
    probes.push_back(std::move(probe));
  }
  return probes;
}

}  // namespace scree
