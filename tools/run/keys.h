// What a stage's result depends on, as one hash: equal keys, equal results.
#pragma once

#include <string>

#include "engine/packing/packing.h"
#include "tools/scene/scene.h"

namespace scree::run {

// Blocks, the mechanical properties of their materials, and the scene's `settle` section.
template <int dim>
std::string packing_key(const Scene& scene, const mesh::BlockMesh<dim>& mesh);

// The packing, the scene's `materials`, `contact`, `heat` and `output` sections, the content of its tables, and the
// temperatures it starts from if they are an earlier run's.
template <int dim>
std::string heat_key(const Scene& scene, const packing::Packing<dim>& packing, const Eigen::VectorXd* start);

// What is known of a packing before anything is meshed: scenes of one key come to the same packing.
std::string fall_key(const Scene& scene);

// All that a whole run depends on: the effective scene, the files it names, and whether errors in space are estimated.
std::string run_key(const Scene& scene, bool space_errors);

// Throws RunError where that is another key, as somebody has changed the scene or a file that it names.
void expect_planned(const Scene& scene, const std::string& key, bool space_errors);

// Of the effective scene, for the summary.
std::string scene_hash(const Scene& scene);

}  // namespace scree::run
