// What drives a scene jumps at an output time that is rounded in two ways: 5 * 3.333 + 3.333 is less than 6 * 3.333 = 19.998.
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

// A bar that radiates at its end, beside one in which a peak of latent heat makes steps short.
double end_after_six_outputs(const std::string& name, const std::string& emissivity) {
  const auto folder = fresh_directory(name);
  std::ofstream(folder / "scene.yaml") << fmt::format(R"yaml(
dimension: 2
materials:
  plain: {{density: 2000, conductivity: 200, specific_heat: 1308}}
  peaked: {{density: 2000, conductivity: 40, specific_heat: {{table: [[369.6, 419.5], [371.6, 41950], [373.6, 209.7]]}}}}
bodies:
  left: {{box: {{size: [0.06, 0.002], centre: [0.03, 0]}}, material: plain, mesh_size: 0.0086, elements: quadrilateral}}
  right: {{box: {{size: [0.1, 0.002], centre: [0.11, 0]}}, material: peaked, mesh_size: 0.05, elements: quadrilateral}}
contact: {{conductance: 600}}
heat:
  initial: {{left: 322.56, right: 328.92}}
  boundaries:
    - body: right
      surface: y_low
      radiation: &sky
        emissivity: {{expression: "0.3967 + 0.285*min(1, max(0, (t - 13.0444)/0.8))"}}
        surroundings: 1200
    - {{body: right, surface: y_high, radiation: *sky}}
    - {{body: left, surface: x_low, radiation: {{emissivity: {{expression: "{}"}}, surroundings: 900}}}}
  until: 23.331 s
  tolerance: 0.02 K
  integrator: implicit
output: {{every: 3.333 s, probes: {{end: [0, 0]}}}}
)yaml",
                                                      emissivity);
  const SceneRun run = run_file(folder / "scene.yaml", folder / "out");
  EXPECT_EQ(run.exit_status, 0) << emissivity;
  return run.probes()["end"].at(6);
}

TEST(AJumpAtAnOutput, DoesNothingBeforeItWhateverItsTimeIsRoundedTo) {
  const double without = end_after_six_outputs("no_jump_at_output", "0.29 + 0*t");
  const double with = end_after_six_outputs("jump_at_output", "t < 19.998 ? 0.29 : 0.8");
  EXPECT_NEAR(with, without, 1e-3) << "0.09 if the last step before it sees what is behind it";
}

}  // namespace
}  // namespace scree::test
