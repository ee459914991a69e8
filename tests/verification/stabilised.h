// What stabilised explicit steps are asked, whatever depends on temperature or changes in time.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/thermal/resumed.h"
#include "thermal/drive.h"
#include "thermal/heat_run.h"
#include "thermal/time_scheme.h"

namespace scree::thermal::test {

inline Instant start_of(const HeatModel& model) {
  Instant at;
  at.temperature = held(model, model.initial, Drives(model).at(0));
  at.error = Eigen::VectorXd::Zero(model.initial.size());
  return at;
}

inline Instant after(TimeScheme& scheme, Instant at, double length, int count) {
  const double begin = at.time;
  for (int n = 0; n < count; ++n) {
    at.time = begin + n * length / count;
    const Step step = scheme.step(at, length / count);
    at.temperature += step.change;
    at.error = step.error;
  }
  at.time = begin + length;
  return at;
}

// From a sudden start; the state is that of implicit steps at a tolerance of 1 mK.
inline void expect_kept(const HeatModel& model, double until, const std::vector<double>& tolerances, const std::string& name) {
  TimeOptions time;
  time.until = until;
  time.output_every = until / 4;
  time.tolerance = 1e-3;
  time.integrator = Integrator::implicit;
  HeatRun exact(model, time);
  exact.advance_to(until);
  for (const double tolerance : tolerances) {
    time.tolerance = tolerance;
    time.integrator = Integrator::stabilised_explicit;
    HeatRun run(model, time);
    run.advance_to(until);
    const double error = (run.state().temperature - exact.state().temperature).lpNorm<Eigen::Infinity>();
    EXPECT_LE(error, run.state().error.lpNorm<Eigen::Infinity>() + exact.state().time_error) << name << " " << tolerance;
    EXPECT_TRUE(run.within_tolerance()) << name << " " << tolerance;
    EXPECT_LT(run.state().ledger.relative_residual(), 1e-12) << name << " " << tolerance;
    EXPECT_EQ(run.state().factorisations, 0) << name << " " << tolerance;
  }
}

// Of two models of the same nodes, for steps of three lengths.
inline void expect_equal_steps(const HeatModel& one, const HeatModel& other, double within) {
  Instant at = start_of(one);
  at.error = 1e-3 * at.temperature.array().sin();
  for (const NodeId node : one.fixed_nodes) at.error[node.value()] = 0;
  for (const double length : {0.1, 10.0, 300.0}) {
    const Step a = make_stabilised_scheme(one)->step(at, length);
    const Step b = make_stabilised_scheme(other)->step(at, length);
    EXPECT_LT((a.change - b.change).lpNorm<Eigen::Infinity>(), within) << length;
    EXPECT_LT((a.error - b.error).lpNorm<Eigen::Infinity>(), within) << length;
    EXPECT_LT((a.local - b.local).lpNorm<Eigen::Infinity>(), within) << length;
  }
}

inline void expect_stabilised_steps_resumed_to_the_bit(const HeatModel& model, const std::string& name) {
  TimeOptions time;
  time.integrator = Integrator::stabilised_explicit;
  time.until = 60;
  time.output_every = 20;
  expect_resumed_to_the_bit(model, time, 20, name);
}

}  // namespace scree::thermal::test
