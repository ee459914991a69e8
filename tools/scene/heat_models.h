// Which parts of the physics of heat a scene asks for, and where.
#pragma once

#include <vector>

#include "tools/scene/doctor.h"

namespace scree {

std::vector<Model> heat_models(const Scene& scene);

// Whether what it conducts or stores depends on temperature.
bool varies(const Material& material);

}  // namespace scree
