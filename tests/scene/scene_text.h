// Scenes from texts, and scenes as texts to compare.
#pragma once

#include <string>
#include <vector>

#include "tools/scene/scene.h"

namespace scree::test {

// A small scene with all sections, in 3-D and heated from below.
extern const char* const whole_scene;

// Reads a text as the scene file s.yaml of a folder of its own.
Scene scene_of(const std::string& yaml, const std::vector<std::string>& overrides = {});

// What is wrong with it, with "s.yaml" for the path; "accepted" if nothing is.
std::string wrong_with(const std::string& yaml, const std::vector<std::string>& overrides = {});

// Every value of a scene but the places in the file and the effective text.
std::string values_of(const Scene& scene);

}  // namespace scree::test
