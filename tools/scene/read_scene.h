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

// The same of a text; paths in it are relative to `folder`.
Scene read_scene_text(const std::string& text, const std::filesystem::path& folder,
                      const std::vector<std::string>& overrides = {});

// An error of a later stage with the places in the scene of the keys it speaks of, where it does not name any.
InputError located(const Scene& scene, const InputError& error);

}  // namespace scree
