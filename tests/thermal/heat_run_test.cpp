#include "thermal/heat_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/temp_folder.h"
#include "tests/thermal/builders.h"
#include "thermal/drive.h"
#include "thermal/stable_step.h"

namespace scree::thermal {
namespace {

using test::bar;
using test::between_x;
using test::options_for;
using test::rock_only;
using test::slab_mesh;

// Rubble of single elements, 2 cm across: each its own block, with joints of stiffness beta.
template <int dim>
HeatModel rubble_model(double beta, const std::function<void(HeatOptions&)>& heat) {
  auto slab = bar<dim>(0.06, 3, 2, 0.04);
  slab.block_per_element = true;
  const auto mesh = slab_mesh<dim>({slab});
  HeatOptions options = options_for(mesh, 298.15);
  options.joint.law = StiffnessFactor{beta};
  heat(options);
  return make_heat_model(mesh, rock_only(), test::matching_contacts(mesh), options);
}

void hot_left(HeatOptions& options) {
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 373.15, "left"));
}
void inner_source(HeatOptions& options) {
  options.sources.push_back({test::on(BodyId{0}, between_x(0, 0.03)), 1e6, "source", {}});
}
void both(HeatOptions& options) {
  hot_left(options);
  inner_source(options);
}

TimeOptions times(double until, double every, double tolerance) {
  TimeOptions options;
  options.until = until;
  options.output_every = every;
  options.tolerance = tolerance;
  return options;
}

std::vector<Eigen::VectorXd> outputs(const HeatModel& model, const TimeOptions& options, HeatState* last = nullptr) {
  HeatRun run(model, options);
  std::vector<Eigen::VectorXd> temperatures;
  for (int k = 1; k * options.output_every <= options.until; ++k) {
    run.advance_to(k * options.output_every);
    temperatures.push_back(run.state().temperature);
  }
  if (last != nullptr) *last = run.state();
  return temperatures;
}

double largest_difference(const std::vector<Eigen::VectorXd>& a, const std::vector<Eigen::VectorXd>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).lpNorm<Eigen::Infinity>());
  return largest;
}

TEST(HeatRun, ToleranceBoundsTheTrueErrorWhateverTheStiffness) {
  for (const double beta : {1e-2, 1.0, 1e3}) {
    for (const auto& heat : {hot_left, inner_source, both}) {
      for (const double every : {0.2, 10.0, 400.0}) {
        for (const double tolerance : {1.0, 0.1}) {
          const HeatModel model = rubble_model<2>(beta, heat);
          HeatState state;
          const auto coarse = outputs(model, times(4 * every, every, tolerance), &state);
          const auto fine = outputs(model, times(4 * every, every, tolerance / 100));
          const double error = largest_difference(coarse, fine);
          EXPECT_LT(error, tolerance) << "beta " << beta << " every " << every;
          EXPECT_LE(error, state.time_error) << "beta " << beta << " every " << every;
          EXPECT_LE(state.time_error, tolerance);
          EXPECT_LT(state.ledger.relative_residual(), 1e-11) << "beta " << beta << " every " << every;
        }
      }
    }
  }
}

// Measured at the end of every step of a dense run: the estimate is of the right size, not a wild bound.
TEST(HeatRun, ErrorEstimateIsWithinAFactorOfThreeOfTheTrueError) {
  for (const double beta : {0.1, 10.0, 1e3}) {
    const HeatModel model = rubble_model<2>(beta, hot_left);
    std::vector<double> steps;
    std::vector<Eigen::VectorXd> temperatures;
    HeatRun coarse(model, times(100, 100, 0.5));
    coarse.advance_to(100, [&](double time) {
      steps.push_back(time);
      temperatures.push_back(coarse.state().temperature);
    });
    HeatRun fine(model, times(100, 0, 0.002));
    double error = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      fine.advance_to(steps[i]);
      error = std::max(error, (fine.state().temperature - temperatures[i]).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LE(error, coarse.state().time_error) << beta;
    EXPECT_GT(error, coarse.state().time_error / 3) << beta;
  }
}

TEST(HeatRun, AnInsulatedPileKeepsItsHeat) {
  auto slab = bar<3>(0.06, 3, 2, 0.04);
  slab.block_per_element = true;
  auto warm = slab;
  warm.low[0] = 0.06;
  const auto mesh = slab_mesh<3>({slab, warm});
  for (const double beta : {0.1, 1e3}) {
    HeatOptions options = options_for(mesh, 300);
    options.initial_temperature[BodyId{1}] = 400;
    options.joint.law = StiffnessFactor{beta};
    const HeatModel model = make_heat_model(mesh, rock_only(), test::matching_contacts(mesh), options);
    HeatRun run(model, times(1000, 100, 0.1));
    run.advance_to(1000);
    const double heat = model.capacity.dot(model.initial);
    EXPECT_NEAR(model.capacity.dot(run.state().temperature) / heat, 1, 1e-12);
    const auto range = std::minmax_element(run.state().temperature.begin(), run.state().temperature.end());
    EXPECT_GT(*range.first, 300);
    EXPECT_LT(*range.second, 400);
  }
}

TEST(HeatRun, LedgerNamesWhatCameInWhere) {
  const HeatModel model = rubble_model<3>(10, both);
  for (const Integrator integrator : {Integrator::implicit, Integrator::stabilised_explicit, Integrator::explicit_euler}) {
    TimeOptions options = times(20, 10, 0.1);
    options.integrator = integrator;
    HeatRun run(model, options);
    run.advance_to(20);
    const Ledger& ledger = run.state().ledger;
    EXPECT_GT(ledger.start_jump, 0);
    EXPECT_GT(ledger.by_boundary.at(0), 0);
    EXPECT_NEAR(ledger.by_applied.at(0), 20 * Drives(model).at(0).by_load.at(0), 1e-9 * ledger.turnover);
    EXPECT_GT(ledger.stored, ledger.start_jump);
    EXPECT_LT(ledger.relative_residual(), 1e-12);
  }
}

TEST(HeatRun, ImplicitAndExplicitAgreeWithinTheirErrors) {
  const HeatModel model = rubble_model<3>(1, both);
  HeatState implicit;
  const auto a = outputs(model, times(60, 20, 0.01), &implicit);
  TimeOptions options = times(60, 20, 0.01);
  options.integrator = Integrator::explicit_euler;
  options.step = stable_step(model).step / 20;
  HeatState euler;
  const auto b = outputs(model, options, &euler);
  EXPECT_LT(largest_difference(a, b), implicit.time_error + euler.time_error);
  EXPECT_GT(largest_difference(a, b), 0);
}

TEST(HeatRun, StabilisedExplicitStepsKeepTheToleranceThatImplicitOnesKeep) {
  const HeatModel model = rubble_model<3>(10, both);
  TimeOptions fine = times(300, 100, 1e-4);
  fine.integrator = Integrator::implicit;
  const auto exact = outputs(model, fine);
  for (const double tolerance : {1.0, 0.1, 0.01}) {
    TimeOptions options = times(300, 100, tolerance);
    options.integrator = Integrator::stabilised_explicit;
    HeatState state;
    const double error = largest_difference(outputs(model, options, &state), exact);
    EXPECT_LE(error, state.time_error) << tolerance;
    EXPECT_LE(state.time_error, tolerance);
    EXPECT_GT(error, 0);
    EXPECT_EQ(state.factorisations, 0);
    EXPECT_LT(state.ledger.relative_residual(), 1e-12);
  }
}

TEST(HeatRun, ChoosesProductsForLooseJointsAndAFactorisationForStiffOnes) {
  const auto solver = [](double beta) {
    const HeatModel model = rubble_model<3>(beta, both);
    return HeatRun(model, times(3600, 600, 0.1)).solver();
  };
  EXPECT_THAT(solver(0.1), testing::HasSubstr("RKL2"));
  EXPECT_THAT(solver(1e6), testing::HasSubstr("CHOLMOD"));
}

TEST(HeatRun, ABlockOfOneElementWarmsAtTheRateOfItsCapacity) {
  mesh::BlockMesh<3> mesh;
  mesh.bodies.push_back({"stone", MaterialId{0}, false, {}});
  for (const auto& point : {Point<3>(0, 0, 0), Point<3>(0.1, 0, 0), Point<3>(0, 0.1, 0), Point<3>(0, 0, 0.1)})
    mesh.nodes.push_back(point);
  mesh.elements.push_back({NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}});
  mesh.blocks.push_back({BodyId{0}, {0, 4}, {0, 1}});
  HeatOptions options = options_for(mesh, 300);
  options.sources.push_back({test::on(BodyId{0}, std::nullopt), 2e6, "source", {}});
  const HeatModel model = make_heat_model(mesh, rock_only(), {}, options);
  HeatRun run(model, times(7, 3, 0.1));
  run.advance_to(7);
  EXPECT_LT((run.state().temperature.array() - 307).abs().maxCoeff(), 1e-10);  // 2e6 W/m3 over 2e6 J/m3/K
  EXPECT_EQ(run.state().time, 7);
}

// The states at these times, from each but the last of which a run goes on from a file to the same last one.
std::vector<HeatState> resumed_to_the_bit(const HeatModel& model, const TimeOptions& options,
                                          const std::vector<double>& stops) {
  const auto file = scree::test::temp_folder() / "resume.h5";
  HeatRun whole(model, options);
  std::vector<HeatState> states;
  for (const double time : stops) {
    whole.advance_to(time);
    states.push_back(whole.state());
  }
  for (std::size_t from = 0; from + 1 < states.size(); ++from) {
    write(states[from], "key", file);
    HeatRun resumed(model, options, read_state(file, "key"));
    resumed.advance_to(stops.back());
    EXPECT_EQ(resumed.state().temperature, states.back().temperature) << from;
    EXPECT_EQ(resumed.state().error, states.back().error);
    EXPECT_EQ(resumed.state().steps, states.back().steps);
    EXPECT_EQ(resumed.state().ledger.by_boundary, states.back().ledger.by_boundary);
  }
  return states;
}

TEST(HeatRun, AResumedRunRepeatsTheUninterruptedOneToTheBit) {
  const HeatModel model = rubble_model<3>(100, both);
  for (const Integrator integrator : {Integrator::implicit, Integrator::stabilised_explicit, Integrator::explicit_euler}) {
    TimeOptions options = times(0.33, 0.1, 0.05);
    options.integrator = integrator;
    resumed_to_the_bit(model, options, {0.1, 0.2, 0.1 * 3, 0.33});
  }
}

TEST(HeatRun, ARunOfMixedStepsGoesOnFromAFileToTheBitBeforeTheChangeAndAfterIt) {
  const HeatModel model = rubble_model<3>(1e6, both);
  const TimeOptions options = times(1, 0.001, 0.05);
  ASSERT_THAT(HeatRun(model, options).solver(), testing::HasSubstr("steps of up to"));
  const std::vector<HeatState> states = resumed_to_the_bit(model, options, {0.001, 0.002, 0.05});
  EXPECT_EQ(states.front().factorisations, 0);
  EXPECT_GT(states.back().factorisations, 0);
}

TEST(HeatRun, MixedStepsAreTheSameWhetherLongOnesAreMadeReadyBesideShortOnesOrNot) {
  const int before = threads_in_use();
  const HeatModel model = rubble_model<3>(1e6, both);
  const auto run = [&](int threads) {
    use_threads(threads);
    HeatRun heat(model, times(1, 0.001, 0.05));
    heat.advance_to(1);
    return std::pair(heat.state(), heat.solver());
  };
  const auto alone = run(1), beside = run(2);
  use_threads(before);
  EXPECT_GT(alone.first.factorisations, 0);
  EXPECT_EQ(alone.second, beside.second);
  EXPECT_EQ(alone.first.factorisations, beside.first.factorisations);
  EXPECT_EQ(alone.first.steps, beside.first.steps);
  EXPECT_EQ(alone.first.temperature, beside.first.temperature);
}

TEST(HeatRun, StepsDoNotDependOnHowOftenTheRunIsStopped) {
  const HeatModel model = rubble_model<2>(10, hot_left);
  HeatRun often(model, times(50, 10, 0.1));
  for (int k = 1; k <= 5; ++k) often.advance_to(10.0 * k);
  HeatRun once(model, times(50, 10, 0.1));
  once.advance_to(50);
  EXPECT_EQ(often.state().temperature, once.state().temperature);
}

// What comes in at one end leaves at the other, under one name.
TEST(HeatRun, HeatThatComesInAndLeavesUnderOneNameIsTurnedOverAllTheSame) {
  const auto mesh = slab_mesh<2>({bar<2>(1, 2, 1, 1)});
  const auto unit = std::get<UnitConverter>(unit_converter("K", quantity::temperature));
  HeatOptions options = options_for(mesh, 300);
  Boundary air;
  air.name = "air";
  air.region = test::on(BodyId{0}, between_x(0, 1));
  air.condition = Convection{10.0, Function::from_expression("300 + 100*(x - 0.5)", unit, ValueRule{})};
  options.boundaries.push_back(air);
  const HeatModel model = make_heat_model(mesh, rock_only(), contact::ContactSet<2>{}, options);
  HeatRun run(model, times(36000, 36000, 0.1));
  run.advance_to(36000);
  EXPECT_GT(run.state().ledger.turnover, 1e4);
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
}

TEST(HeatRun, NothingHappensAtASteadyState) {
  const HeatModel model = rubble_model<2>(
      10, [](HeatOptions& options) { options.boundaries.push_back(test::hold(BodyId{0}, 0, 298.15, "as cold as the rest")); });
  HeatRun run(model, times(1000, 100, 0.1));
  run.advance_to(1000);
  EXPECT_EQ(run.state().steps, 5) << "two outputs are passed at once after three steps, and four";
  EXPECT_LT((run.state().temperature - model.initial).lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_EQ(run.state().ledger.relative_residual(), 0);
}

TEST(HeatRun, AModelWithEveryNodeFixedStandsStill) {
  const HeatModel model = rubble_model<2>(10, [](HeatOptions& options) {
    options.boundaries.push_back({test::on(BodyId{0}, std::nullopt), FixedTemperature{350}, "all", {}});
  });
  HeatRun run(model, times(100, 10, 0.1));
  run.advance_to(100);
  EXPECT_EQ(run.state().temperature, Eigen::VectorXd::Constant(model.initial.size(), 350.0));
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-14);
}

TEST(ExplicitStep, TheStableStepIsRefusedAboveAndNamesTheBlock) {
  const HeatModel model = rubble_model<2>(10, hot_left);
  const StableStep stable = stable_step(model);
  TimeOptions options = times(1, 1, 0.1);
  options.integrator = Integrator::explicit_euler;
  options.step = 1.001 * stable.step;
  try {
    HeatRun run(model, options);
    FAIL();
  } catch (const InputError& error) {
    const std::string block = "block " + std::to_string(model.blocks[stable.node].value());
    EXPECT_THAT(error.what(), testing::HasSubstr("must be at most the stable step of"));
    EXPECT_THAT(error.what(), testing::HasSubstr(block));
  }
}

// A number of steps beyond the largest integer was none at all.
TEST(ExplicitStep, MoreStepsThanAnyoneWaitsForAreRefused) {
  const HeatModel model = rubble_model<2>(10, hot_left);
  TimeOptions options = times(1, 1, 0.1);
  options.integrator = Integrator::explicit_euler;
  for (const double step : {1e-10, 1e-20, 1e-300}) {
    options.step = step;
    EXPECT_THAT([&] { HeatRun(model, options); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("must be at most 1e+09 explicit steps")))
        << step;
  }
}

// No bound is above Gershgorin's, which is at most twice the largest diagonal entry, and no diagonal entry of a symmetric
// matrix exceeds its largest eigenvalue: so twice the bound is beyond any stable step.
TEST(ExplicitStep, TheBoundIsStableAndTwiceTheBoundIsNot) {
  const HeatModel model = rubble_model<2>(10, hot_left);
  const double bound = stable_step(model).step;
  const auto grown = [&](double step) {
    Eigen::VectorXd temperature(model.initial.size());
    for (Eigen::Index i = 0; i < temperature.size(); ++i) temperature[i] = std::sin(1.0 + 7.0 * static_cast<double>(i));
    for (const NodeId node : model.fixed_nodes) temperature[node.value()] = 0;
    for (int n = 0; n < 20000; ++n) {
      Eigen::VectorXd change = -step * (model.conductance * temperature).cwiseQuotient(model.capacity);
      for (const NodeId node : model.fixed_nodes) change[node.value()] = 0;
      temperature += change;
      if (temperature.lpNorm<Eigen::Infinity>() > 1e6) break;
    }
    return temperature.lpNorm<Eigen::Infinity>();
  };
  EXPECT_LT(grown(bound), 2);
  EXPECT_GT(grown(2.02 * bound), 1e6);
}

}  // namespace
}  // namespace scree::thermal
