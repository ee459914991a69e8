#include <fmt/format.h>

#include "tools/scene/sections.h"

namespace scree {

namespace {

constexpr double most_steps = 1e9;  // of a fall: more are no fall that anyone waits for

}  // namespace

SettleStage read_settle(const Checked& settle, Problems& problems) {
  SettleStage stage;
  rigid::SettleOptions& options = stage.options;
  options.gravity = settle.at("gravity").vector();
  options.limit = settle.at("limit").number();
  options.step = settle.at("step").number();
  options.local_damping = settle.at("local_damping").number();
  options.viscous_damping = settle.at("viscous_damping").number();
  options.release_time = settle.at("release_time").number();
  options.rest_speed = settle.at("rest_speed").number();
  options.rest_unbalanced_force = settle.at("rest_unbalanced_force").number();
  options.rest_displacement = settle.at("rest_displacement").number();
  options.rest_window = settle.at("rest_window").number();
  options.clearance = settle.at("clearance").number();
  stage.clearance_at = settle.at("clearance").where;
  options.iterations = settle.at("iterations").integer();
  options.frame_interval = settle.at("frame_interval").number();
  stage.seed = settle.at("seed").integer();
  stage.largest_overlap = settle.at("largest_overlap").number();
  stage.accept_moving = settle.at("accept_moving").flag();

  const Checked& drag = settle.at("viscous_damping");
  if (drag.sound && settle.at("step").sound && options.viscous_damping * options.step > 1) {
    problems.push_back(drag.problem(drag.text, fmt::format("must be at most {:g} 1/s, one over the step", 1 / options.step)));
  }
  const Checked& step = settle.at("step");
  if (step.sound && settle.at("limit").sound && options.step > options.limit) {
    problems.push_back(step.problem(step.text, fmt::format("must be at most settle.limit, {:g} s", options.limit)));
  }
  if (step.sound && settle.at("limit").sound && options.step < options.limit / most_steps) {
    problems.push_back(step.problem(step.text, fmt::format("must be at least {:g} s, for {:g} steps to settle.limit",
                                                           options.limit / most_steps, most_steps)));
  }
  const Checked& gravity = settle.at("gravity");
  if (gravity.sound && options.gravity.norm() == 0) {
    problems.push_back(
        gravity.problem("zero", "nothing falls without it", "Leave settle out to keep the bodies where they are"));
  }
  return stage;
}

}  // namespace scree
