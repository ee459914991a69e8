// A scene file to a Scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/scene/scene.h"

namespace scree {

// Reads, overrides (`key.path=value`) and checks a scene. Throws InputError with everything that is wrong with it, in the
// order of the file.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace scree
