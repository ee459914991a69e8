// A scene's packing, without files.
#pragma once

#include <functional>

#include "engine/packing/packing.h"
#include "tools/scene/scene.h"

namespace scree {

// Settles the blocks, reads the packing file the scene names, or leaves them where they were placed. `progress` is told the
// simulated time after every step of a fall, and may throw to stop it.
template <int dim>
packing::Packing<dim> make_packing(const Scene& scene, const std::function<void(double)>& progress = {});

}  // namespace scree
