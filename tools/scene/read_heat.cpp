#include <algorithm>
#include <tuple>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/nearest.h"
#include "tools/scene/heat_keys.h"
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

using BoundaryCondition = decltype(thermal::Boundary::condition);

// A total has one value for all its faces.
Function read_flow(const Checked& flow, Problems& problems) {
  Function function = read_function(flow, problems);
  if (function.varies_in_place()) {
    problems.push_back(
        flow.problem("a function of place", "must depend on time only", "Use flux for one that varies in place"));
  }
  return function;
}

// The one condition of a boundary, and what it is called.
BoundaryCondition read_condition(const Checked& part, std::string& kind, Problems& problems) {
  const auto function = [&](const Checked& of, const char* key) { return read_function(of.at(key), problems); };
  for (const char* name : {"temperature", "flux", "flow", "convection", "radiation"}) {
    if (part.find(name) == nullptr) continue;
    kind = name;
    break;
  }
  if (kind == "flux") return thermal::HeatFlux{function(part, "flux")};
  if (kind == "flow") return thermal::HeatFlow{read_flow(part.at("flow"), problems)};
  if (kind == "convection") {
    const Checked& convection = part.at("convection");
    return thermal::Convection{function(convection, "coefficient"), function(convection, "surroundings")};
  }
  if (kind == "radiation") {
    const Checked& radiation = part.at("radiation");
    return thermal::Radiation{function(radiation, "emissivity"), function(radiation, "surroundings")};
  }
  return thermal::FixedTemperature{function(part, "temperature")};
}

thermal::Boundary read_boundary(const Checked& part, Names& names, int dimension, Problems& problems) {
  thermal::Boundary boundary;
  boundary.region = read_region(part, names, dimension, problems);
  std::string kind;
  boundary.condition = read_condition(part, kind, problems);
  boundary.name = ledger_name(part, kind, names, problems);
  boundary.where = part.where;
  return boundary;
}

thermal::Source read_source(const Checked& part, Names& names, int dimension, Problems& problems) {
  thermal::Source source;
  source.region = read_region(part, names, dimension, problems);
  source.power = read_function(part.at("power"), problems);
  source.name = ledger_name(part, "source", names, problems);
  source.where = part.where;
  return source;
}

// A temperature at t = 0.
Function read_start(const Checked& value, Problems& problems) {
  Function function = read_function(value, problems);
  if (function.varies_in_time()) {
    problems.push_back(value.problem("a function of time", "must depend on place only", "The start is at t = 0"));
  }
  return function;
}

Table<BodyId, Function> read_bodies_initial(const Checked& initial, const Names& names, Problems& problems) {
  Table<BodyId, Function> result(names.bodies.size());
  std::vector<std::string> missing = names.bodies;
  for (const CheckedEntry& entry : initial.entries) {
    const auto place = std::find(names.bodies.begin(), names.bodies.end(), entry.name);
    if (place == names.bodies.end()) {
      problems.push_back(
          {entry.where, entry.value.path, "unknown", "must be a body of this scene", suggest(entry.name, names.bodies)});
      continue;
    }
    const BodyId body{static_cast<std::size_t>(place - names.bodies.begin())};
    result[body] = read_start(entry.value, problems);
    std::erase(missing, entry.name);
  }
  if (!missing.empty()) {
    problems.push_back(
        initial.problem(fmt::format("without {}", fmt::join(missing, ", ")), "every body must have a temperature"));
  }
  return result;
}

// One temperature for all bodies, or one for each; from an earlier run the stage reads them later.
Table<BodyId, Function> read_initial(const Checked& initial, const Names& names, Problems& problems) {
  const bool by_body =
      initial.is_map && (initial.entries.empty() || initial.entries.front().value.key->path == "heat.initial.*");
  if (by_body) return read_bodies_initial(initial, names, problems);
  return {names.bodies.size(), read_start(initial, problems)};
}

auto functions_of(const thermal::FixedTemperature& c) {
  return std::tie(c.temperature);
}
auto functions_of(const thermal::HeatFlux& c) {
  return std::tie(c.flux);
}
auto functions_of(const thermal::HeatFlow& c) {
  return std::tie(c.flow);
}
auto functions_of(const thermal::Convection& c) {
  return std::tie(c.coefficient, c.surroundings);
}
auto functions_of(const thermal::Radiation& c) {
  return std::tie(c.emissivity, c.surroundings);
}

void check_times(const thermal::HeatOptions& options, Problems& problems) {
  const auto check = [&](const Function& function) { check_lasts(function, options, problems); };
  const auto check_all = [&](const auto&... functions) { (check(functions), ...); };
  for (const thermal::Boundary& boundary : options.boundaries) {
    std::visit([&](const auto& condition) { std::apply(check_all, functions_of(condition)); }, boundary.condition);
  }
  for (const thermal::Source& source : options.sources) check(source.power);
}

thermal::BlockModel read_block_model(const std::string& word) {
  using enum thermal::BlockModel;
  if (word == "lumped") return lumped;
  return word == "auto" ? automatic : meshed;
}

thermal::BlockOptions read_blocks(const Checked& heat, const Names& names, Problems& problems) {
  thermal::BlockOptions options;
  const Checked* blocks = heat.find("blocks");
  if (blocks == nullptr) return options;
  options.where = blocks->where;
  options.model = read_block_model(blocks->at("model").text);
  options.largest_biot = blocks->at("largest_biot").number();
  for (const CheckedEntry& entry : blocks->at("bodies").entries) {
    const auto place = std::find(names.bodies.begin(), names.bodies.end(), entry.name);
    if (place == names.bodies.end()) {
      problems.push_back(
          {entry.where, entry.value.path, "unknown", "must be a body of this scene", suggest(entry.name, names.bodies)});
      continue;
    }
    const BodyId body{static_cast<std::size_t>(place - names.bodies.begin())};
    options.of_body[body] = read_block_model(entry.value.text);
  }
  const auto is_automatic = [](const auto& chosen) { return chosen.second == thermal::BlockModel::automatic; };
  const bool any_automatic = options.model == thermal::BlockModel::automatic ||
                             std::any_of(options.of_body.begin(), options.of_body.end(), is_automatic);
  // A scene with its defaults filled in may be read again.
  const bool own_limit = options.largest_biot != thermal::BlockOptions{}.largest_biot;
  if (const Checked& biot = blocks->at("largest_biot"); biot.sound && own_limit && !any_automatic) {
    problems.push_back(biot.problem(fmt::format("{:g}", biot.number()), "decides nothing where no block is auto",
                                    "Take it out, or set heat.blocks.model to auto"));
  }
  if (!options.all_meshed() && heat.find("effective_conductivity") != nullptr) {
    problems.push_back(blocks->problem("lumped or auto", "must be meshed for heat.effective_conductivity",
                                       "The flux inside the blocks is what it measures: take heat.blocks out"));
  }
  return options;
}

thermal::Integrator read_integrator(const std::string& word) {
  const auto found = std::find(integrator_words.begin(), integrator_words.end(), word);
  return found == integrator_words.end() ? thermal::Integrator::automatic
                                         : static_cast<thermal::Integrator>(found - integrator_words.begin());
}

thermal::LinearSolver read_solver(const std::string& word) {
  using enum thermal::LinearSolver;
  if (word == "cholesky") return cholesky;
  return word == "multigrid" ? multigrid : automatic;
}

thermal::TimeOptions read_time(const Checked& heat, const Checked& output) {
  thermal::TimeOptions time;
  time.steady = heat.at("steady").flag();
  if (const Checked* solver = heat.find("solver")) time.solver = read_solver(solver->text);
  if (time.steady) return time;
  time.until = heat.at("until").number();
  time.tolerance = heat.at("tolerance").number();
  time.output_every = output.at("every").number();
  time.integrator = read_integrator(heat.at("integrator").text);
  if (const Checked* step = heat.find("step")) time.step = step->number();
  return time;
}

thermal::SpaceOrder read_space_order(const Checked& heat, const thermal::HeatOptions& options, Problems& problems) {
  if (options.time.steady || heat.at("space_order").text != "4") return thermal::SpaceOrder::second;
  const Checked& order = heat.at("space_order");
  const auto refuse = [&](const char* rule) { problems.push_back(order.problem("4", rule, "Set space_order: 2")); };
  if (!options.blocks.all_meshed()) refuse("must have meshed blocks");
  using enum thermal::Integrator;
  if (const auto asked = options.time.integrator; asked == implicit || asked == explicit_euler) {
    refuse("must be done in stabilised explicit steps");
  }
  return thermal::SpaceOrder::fourth;
}

}  // namespace

std::optional<output::StoredField> read_initial_field(const Checked& initial) {
  const Checked* from = initial.find("from");
  if (from == nullptr || from->key->path != "heat.initial.from") return std::nullopt;
  output::StoredField field;
  field.from = from->text;
  if (const Checked* time = initial.find("time")) field.time = time->number();
  field.reach = initial.at("reach").number();
  field.where = from->where;
  return field;
}

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
  options.blocks = read_blocks(heat, names, problems);
  options.time = read_time(heat, scene.at("output"));
  options.space_order = read_space_order(heat, options, problems);
  check_times(options, problems);
  return options;
}

}  // namespace scree
