#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/nearest.h"
#include "tools/scene/sections.h"

namespace scree {

namespace {

struct Names {
  std::vector<std::string> bodies;
  std::vector<std::string> taken;  // by boundaries and sources
};

// The name the user gave, or the kind and the body, counted if that is taken.
std::string ledger_name(const Checked& part, const std::string& kind, Names& names, Problems& problems) {
  const auto taken = [&](const std::string& name) {
    return std::find(names.taken.begin(), names.taken.end(), name) != names.taken.end();
  };
  const Checked* given = part.find("name");
  std::string name = given == nullptr ? fmt::format("{} of {}", kind, part.at("body").text) : given->text;
  if (given != nullptr && given->sound && taken(name)) {
    problems.push_back(given->problem(name, "must differ from the names of other boundaries and sources"));
  }
  const std::string stem = name;
  for (int i = 2; taken(name); ++i) name = fmt::format("{} {}", stem, i);
  names.taken.push_back(name);
  return name;
}

thermal::Region read_region(const Checked& part, const Names& names, int dimension, Problems& problems) {
  thermal::Region region;
  region.body = resolve<BodyId>(part.at("body"), names.bodies, "body", problems);
  if (const Checked* surface = part.find("surface")) region.surface = surface->text;
  if (const Checked* within = part.find("within")) {
    check_corners(*within, Flat::allowed, dimension, problems);
    region.within = Aabb<3>(within->at("low").vector(), within->at("high").vector());
  }
  return region;
}

thermal::Boundary read_boundary(const Checked& part, Names& names, int dimension, Problems& problems) {
  thermal::Boundary boundary;
  boundary.region = read_region(part, names, dimension, problems);
  std::string kind = "temperature";
  if (const Checked* flux = part.find("flux")) {
    kind = "flux";
    boundary.condition = thermal::HeatFlux{flux->number()};
  } else if (const Checked* flow = part.find("flow")) {
    kind = "flow";
    boundary.condition = thermal::HeatFlow{flow->number()};
  } else {
    boundary.condition = thermal::FixedTemperature{part.at("temperature").number()};
  }
  boundary.name = ledger_name(part, kind, names, problems);
  boundary.where = part.where;
  return boundary;
}

thermal::Source read_source(const Checked& part, Names& names, int dimension, Problems& problems) {
  thermal::Source source;
  source.region = read_region(part, names, dimension, problems);
  source.power = part.at("power").number();
  source.name = ledger_name(part, "source", names, problems);
  source.where = part.where;
  return source;
}

// One temperature for all bodies, or one for each.
Table<BodyId, Function> read_initial(const Checked& initial, const Names& names, Problems& problems) {
  Table<BodyId, Function> result(names.bodies.size(), initial.number());
  if (!initial.is_map) return result;
  for (const CheckedEntry& entry : initial.entries) {
    const auto place = std::find(names.bodies.begin(), names.bodies.end(), entry.name);
    if (place == names.bodies.end()) {
      problems.push_back(
          {entry.where, entry.value.path, "unknown", "must be a body of this scene", suggest(entry.name, names.bodies)});
      continue;
    }
    result[BodyId{static_cast<std::size_t>(place - names.bodies.begin())}] = entry.value.number();
  }
  std::vector<std::string> missing;
  for (const std::string& body : names.bodies) {
    if (initial.find(body) == nullptr) missing.push_back(body);
  }
  if (!missing.empty()) {
    problems.push_back(
        initial.problem(fmt::format("without {}", fmt::join(missing, ", ")), "every body must have a temperature"));
  }
  return result;
}

thermal::TimeOptions read_time(const Checked& heat, const Checked& output) {
  thermal::TimeOptions time;
  time.until = heat.at("until").number();
  time.tolerance = heat.at("tolerance").number();
  time.output_every = output.at("every").number();
  const bool euler = heat.at("integrator").text == "explicit_euler";
  time.integrator = euler ? thermal::Integrator::explicit_euler : thermal::Integrator::implicit;
  if (const Checked* step = heat.find("step")) time.step = step->number();
  return time;
}

}  // namespace

std::optional<Aabb<3>> read_effective_window(const Checked& heat, int dimension, Problems& problems) {
  const Checked* window = heat.find("effective_conductivity");
  if (window == nullptr) return std::nullopt;
  check_corners(*window, Flat::refused, dimension, problems);
  return Aabb<3>(window->at("low").vector(), window->at("high").vector());
}

thermal::HeatOptions read_heat(const Checked& scene, Problems& problems) {
  const Checked& heat = scene.at("heat");
  const int dimension = scene.at("dimension").text == "2" ? 2 : 3;
  Names names{names_of(scene.at("bodies")), {}};

  thermal::HeatOptions options;
  options.initial_temperature = read_initial(heat.at("initial"), names, problems);
  for (const Checked& part : heat.at("boundaries").items) {
    options.boundaries.push_back(read_boundary(part, names, dimension, problems));
  }
  for (const Checked& part : heat.at("sources").items) {
    options.sources.push_back(read_source(part, names, dimension, problems));
  }
  options.joint = read_joint(scene, problems);
  options.time = read_time(heat, scene.at("output"));
  return options;
}

}  // namespace scree
