#include "tests/study/study_text.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/temp_folder.h"
#include "tools/study/read_study.h"

namespace scree::test {

const char* const falling_scene = R"(
materials: {ore: {density: 2500, conductivity: 3, specific_heat: 880, friction: 0.5}}
bodies:
  plate: {box: {size: [1, 1, 0.1], centre: [0, 0, -0.05]}, material: ore, mesh_size: 0.3, fixed: true}
  block: {box: {size: [0.2, 0.2, 0.2], centre: [0, 0, 0.11]}, material: ore, mesh_size: 0.2}
settle: {limit: 5 s}
contact: {stiffness_factor: 10}
heat:
  initial: 300
  boundaries: [{body: plate, temperature: 400}]
  until: 10 h
  tolerance: 1 K
output: {every: 1 h, probes: {top: {point: [0, 0, 0.15], reach: 2 cm}}}
)";

std::filesystem::path study_file(const std::string& scene, const std::string& study) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = temp_folder() / (std::string(info->test_suite_name()) + info->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "scene.yaml") << scene;
  std::ofstream(folder / "s.yaml") << study;
  return folder / "s.yaml";
}

study::Study study_of(const std::string& text) {
  return study::read_study(study_file(falling_scene, text));
}

std::string wrong_with(const std::string& text) {
  const auto file = study_file(falling_scene, text);
  try {
    study::plan(study::read_study(file));
    return "accepted";
  } catch (const InputError& error) {
    std::string what = error.what();
    const std::string folder = file.parent_path().string() + "/";
    for (std::size_t at = 0; (at = what.find(folder)) != std::string::npos;) what.erase(at, folder.size());
    return what;
  }
}

}  // namespace scree::test
