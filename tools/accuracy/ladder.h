// Which runs `scree accuracy` makes of a scene.
#pragma once

#include <vector>

#include "tools/accuracy/rung.h"
#include "tools/scene/scene.h"

namespace scree::accuracy {

// What the user asked to vary; an empty list: what suits the scene.
struct LadderOptions {
  std::vector<double> mesh_factors;
  std::vector<double> tolerances;  // [K]
  std::vector<std::string> integrators;
  std::vector<std::string> contact_models;
  std::vector<std::string> block_models;
};

// Every combination, the coarsest first. Throws InputError for a mesh to be varied that makes the blocks or is given
// whole, for a run that would be made twice, and for a single one without an exact solution.
std::vector<Rung> ladder_of(const Scene& scene, const LadderOptions& options);

// The run with the finest mesh, the fewest lumped blocks and the smallest tolerance, by steps chosen from it if there are any.
std::size_t finest(const std::vector<Rung>& ladder);

// As `--set` takes them.
std::vector<std::string> overrides_of(const Scene& scene, const Rung& rung);

}  // namespace scree::accuracy
