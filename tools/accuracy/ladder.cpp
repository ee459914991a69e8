#include "tools/accuracy/ladder.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "engine/mesh/mesh_file.h"
#include "tools/scene/heat_keys.h"

namespace scree::accuracy {

namespace {

// Whether there is a finer mesh, and it leaves the blocks what they are. The mesh of a file other than a surface is what it is.
bool mesh_can_vary(const Scene& scene) {
  const auto is_given = [](const mesh::BodySpec& body) {
    const auto* file = std::get_if<mesh::MeshFile>(&body.shape);
    return file != nullptr && mesh::extension_of(*file) != ".stl";
  };
  if (std::all_of(scene.bodies.begin(), scene.bodies.end(), is_given)) return false;
  return !scene.settle && !scene.packing &&
         std::none_of(scene.bodies.begin(), scene.bodies.end(),
                      [](const mesh::BodySpec& body) { return body.blocks == mesh::BlockRule::per_element; });
}

void refuse_mesh_factors(const Scene& scene) {
  Problem problem;
  problem.where.file = scene.file.string();
  problem.key = "--mesh";
  problem.value = "given";
  problem.rule =
      "must not be varied where blocks are single elements, fall, or come from a packing file (it would be another pile), nor "
      "where all meshes are files";
  problem.suggestion = "Vary --tolerance, --integrator, --contact or --blocks";
  throw InputError(problem);
}

void refuse_time_options(const Scene& scene, const LadderOptions& options) {
  Problem problem;
  problem.where.file = scene.file.string();
  problem.key = options.tolerances.empty() ? "--integrator" : "--tolerance";
  problem.value = "given";
  problem.rule = "has no use for a steady state, which takes no steps in time";
  problem.suggestion = "Vary --mesh, --contact or --blocks";
  throw InputError(problem);
}

template <class Value>
std::vector<Value> or_else(const std::vector<Value>& given, std::vector<Value> otherwise) {
  return given.empty() ? otherwise : given;
}

struct Models {
  std::string blocks;
  std::string contact;
  std::string integrator;
};

std::vector<Models> models_of(const LadderOptions& options, const std::string& own_integrator) {
  std::vector<Models> models;
  for (const std::string& blocks : or_else(options.block_models, {std::string()})) {
    for (const std::string& contact : or_else(options.contact_models, {std::string()})) {
      for (const std::string& integrator : or_else(options.integrators, {own_integrator})) {
        models.push_back({blocks, contact, integrator});
      }
    }
  }
  return models;
}

// How far the blocks are from being meshed.
int lumping(const std::string& block_model) {
  return block_model == "lumped" ? 2 : (block_model == "auto" ? 1 : 0);
}

// Errors are differences: to an exact solution, or to another run.
void check_ladder(const Scene& scene, const std::vector<Rung>& ladder) {
  std::set<std::vector<std::string>> different;
  for (const Rung& rung : ladder) different.insert(overrides_of(scene, rung));
  const bool exact = std::any_of(scene.probes.begin(), scene.probes.end(), [](const auto& probe) { return probe.exact; });
  Problem problem;
  problem.key = "the ladder of --mesh, --tolerance, --integrator, --contact and --blocks";
  problem.value = fmt::format("{} runs, {} of them different", ladder.size(), different.size());
  if (different.size() < ladder.size()) {
    problem.rule = "must not make a run twice";
    throw InputError(problem);
  }
  if (exact || ladder.size() > 1) return;
  problem.rule = "must be at least two runs, since the scene names no exact solution";
  throw InputError(problem);
}

}  // namespace

std::vector<Rung> ladder_of(const Scene& scene, const LadderOptions& options) {
  if (!options.mesh_factors.empty() && !mesh_can_vary(scene)) refuse_mesh_factors(scene);
  const bool steady = scene.heat->time.steady;
  if (steady && !(options.tolerances.empty() && options.integrators.empty())) refuse_time_options(scene, options);
  const double tolerance = scene.heat->time.tolerance;
  auto factors = or_else(options.mesh_factors, mesh_can_vary(scene) ? std::vector<double>{2, 1, 0.5} : std::vector<double>{1});
  auto tolerances = or_else(options.tolerances, steady ? std::vector<double>{tolerance}
                                                       : std::vector<double>{10 * tolerance, tolerance, 0.1 * tolerance});
  std::sort(factors.rbegin(), factors.rend());
  std::sort(tolerances.rbegin(), tolerances.rend());
  std::vector<Rung> ladder;
  for (const Models& models : models_of(options, integrator_words.at(static_cast<std::size_t>(scene.heat->time.integrator)))) {
    for (const double factor : factors) {
      // Explicit steps follow from stability, whatever the tolerance.
      const bool chooses_steps = models.integrator != "explicit_euler";
      const std::vector<double> varied = chooses_steps ? tolerances : std::vector<double>{tolerances.front()};
      for (const double asked : varied) ladder.push_back({factor, asked, models.integrator, models.contact, models.blocks});
    }
  }
  check_ladder(scene, ladder);
  return ladder;
}

std::size_t finest(const std::vector<Rung>& ladder) {
  const auto coarseness = [](const Rung& rung) {
    return std::tuple(rung.mesh_factor, lumping(rung.block_model), rung.integrator == "explicit_euler" ? 1 : 0, rung.tolerance);
  };
  const auto best = std::min_element(ladder.begin(), ladder.end(),
                                     [&](const Rung& a, const Rung& b) { return coarseness(a) < coarseness(b); });
  return static_cast<std::size_t>(best - ladder.begin());
}

std::vector<std::string> overrides_of(const Scene& scene, const Rung& rung) {
  std::vector<std::string> overrides;
  if (rung.mesh_factor != 1) {
    for (const mesh::BodySpec& body : scene.bodies) {
      overrides.push_back(fmt::format("bodies.{}.mesh_size={:.17g} m", body.name, rung.mesh_factor * body.mesh_size));
    }
  }
  if (!scene.heat->time.steady) {
    overrides.push_back(fmt::format("heat.tolerance={:.17g} K", rung.tolerance));
    overrides.push_back("heat.integrator=" + rung.integrator);
    if (rung.integrator != "explicit_euler" && scene.places.contains("heat.step")) overrides.emplace_back("heat.step=null");
  }
  // Of all bodies and joints, whatever the scene says of some.
  if (!rung.block_model.empty()) {
    overrides.push_back("heat.blocks.model=" + rung.block_model);
    if (scene.places.contains("heat.blocks.bodies")) overrides.emplace_back("heat.blocks.bodies=null");
  }
  if (!rung.contact_model.empty()) {
    overrides.push_back("contact.model=" + rung.contact_model);
    for (std::size_t i = 0; i < scene.heat->joint.rules.size(); ++i) {
      const std::string model = fmt::format("contact.joints[{}].model", i);
      if (scene.places.contains(model)) overrides.push_back(model + "=null");
    }
  }
  return overrides;
}

}  // namespace scree::accuracy
