// A scene's packing, without files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/packing/packing.h"
#include "tools/scene/scene.h"

namespace scree {

// Settles the blocks, reads the packing file the scene names, or leaves them where they were placed. `progress` is told the
// simulated time after every step of a fall, and may throw to stop it. What is to be said against the packing, such as that it
// still moves, faults_of() tells.
template <int dim>
packing::Packing<dim> make_packing(const Scene& scene, const std::function<void(double)>& progress = {});

// Why the command would not call a run with this packing complete; empty if there is no reason.
template <int dim>
std::vector<std::string> faults_of(const Scene& scene, const packing::Packing<dim>& packing);

}  // namespace scree
