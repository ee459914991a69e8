// The settling certificate: what a settled pile is, measured on its frozen geometry and on the last forces of the fall.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/packing/packing.h"
#include "tools/scene/scene.h"

namespace scree::run {

// Of a scene that settles. tools/README.md lists the keys; SI units, angles in degrees where the name says so.
nlohmann::ordered_json certificate(const Scene& scene, const packing::Packing<3>& packing);

}  // namespace scree::run
