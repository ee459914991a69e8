// Studies from texts.
#pragma once

#include <filesystem>
#include <string>

#include "tools/study/plan.h"

namespace scree::test {

// A scene with a falling block and a probe, and one without motion, for studies to vary.
extern const char* const falling_scene;

// Writes the scene and a study of it into a folder of its own and gives the study's file.
std::filesystem::path study_file(const std::string& scene, const std::string& study);

study::Study study_of(const std::string& text);

// What is wrong with a study of the falling scene, with "s.yaml" for its path; "accepted" if nothing is.
std::string wrong_with(const std::string& text);

}  // namespace scree::test
