#include <fmt/format.h>

#include "tools/scene/sections.h"

namespace scree {

namespace {

constexpr double most_steps = 1e9;  // of a fall: more are no fall that anyone waits for

void check_times(const Checked& settle, const rigid::SettleOptions& options, Problems& problems) {
  if (!settle.at("limit").sound) return;
  const auto expect = [&](const char* key, bool good, const std::string& rule) {
    const Checked& time = settle.at(key);
    if (time.sound && !good) problems.push_back(time.problem(time.text, rule));
  };
  expect("step", options.step <= options.limit, fmt::format("must be at most settle.limit, {:g} s", options.limit));
  expect("step", options.step >= options.limit / most_steps,
         fmt::format("must be at least {:g} s, for {:g} steps to settle.limit", options.limit / most_steps, most_steps));
  if (settle.at("accept_moving").flag()) return;
  expect("step", options.step <= options.rest_window / 2,
         fmt::format("must be at most half of settle.rest_window, {:g} s: a single step shows no rest", options.rest_window));
  expect("limit", options.limit >= options.rest_window,
         fmt::format("must be at least settle.rest_window, {:g} s: no pile is at rest before", options.rest_window));
  expect("limit", options.limit >= options.release_time,
         fmt::format("must be at least settle.release_time, {:g} s: no pile is at rest before", options.release_time));
}

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
  check_times(settle, options, problems);
  const Checked& gravity = settle.at("gravity");
  if (gravity.sound && options.gravity.norm() == 0) {
    problems.push_back(
        gravity.problem("zero", "nothing falls without it", "Leave settle out to keep the bodies where they are"));
  }
  return stage;
}

}  // namespace scree
