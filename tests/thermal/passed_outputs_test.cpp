// Outputs that steps pass.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/temp_folder.h"
#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

using test::bar;

// Two bars and a joint; the left end is held at a temperature.
HeatModel heated_pair(const Function& held, double beta, const Curve& specific_heat = 800.0) {
  auto right = bar<2>(0.1, 8, 2, 0.05);
  right.low[0] = 0.1;
  const auto mesh = test::slab_mesh<2>({bar<2>(0.1, 8, 2, 0.05), right});
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{beta};
  Boundary end = test::hold(BodyId{0}, 0, 0, "end");
  end.condition = FixedTemperature{held};
  options.boundaries.push_back(end);
  Table<MaterialId, Material> materials = test::rock_only();
  materials[MaterialId{0}].specific_heat = specific_heat;
  return make_heat_model(mesh, materials, test::matching_contacts(mesh), options);
}

TimeOptions two_hours(double every, Integrator integrator = Integrator::automatic) {
  TimeOptions options;
  options.until = 7200;
  options.output_every = every;
  options.integrator = integrator;
  return options;
}

struct Followed {
  std::vector<double> times;
  std::vector<Eigen::VectorXd> temperatures;
  std::vector<HeatState> states;  // of those from which a run could go on
};

Followed follow(HeatRun& run) {
  Followed followed;
  run.follow([&](const HeatRun::Output& output) {
    followed.times.push_back(output.time);
    followed.temperatures.push_back(output.temperature);
    if (output.resumable) followed.states.push_back(run.state());
  });
  return followed;
}

// By how much outputs every 20 s are off beside a run with a fiftieth of the tolerance, over the time errors of both.
double off_over_time_error(const HeatModel& model, Integrator integrator, Followed& coarse) {
  TimeOptions fine = two_hours(20, integrator);
  fine.tolerance = 0.002;
  HeatRun run(model, two_hours(20, integrator)), fine_run(model, fine);
  coarse = follow(run);
  const Followed exact = follow(fine_run);
  EXPECT_EQ(coarse.times, exact.times);
  EXPECT_TRUE(run.within_tolerance());
  double largest = 0;
  for (std::size_t i = 0; i < coarse.times.size(); ++i) {
    largest = std::max(largest, (coarse.temperatures[i] - exact.temperatures[i]).lpNorm<Eigen::Infinity>());
  }
  return largest / (run.state().time_error + fine_run.state().time_error);
}

class PassedOutputs : public ::testing::TestWithParam<Integrator> {};

TEST_P(PassedOutputs, CostNoSteps) {
  for (const double beta : {1.0, 1e3, 1e6}) {
    const HeatModel model = heated_pair(400, beta);
    const auto steps_with = [&](double every) {
      HeatRun run(model, two_hours(every, GetParam()));
      EXPECT_EQ(follow(run).times.size(), 7200 / every);
      EXPECT_TRUE(run.within_tolerance());
      return static_cast<double>(run.state().steps);
    };
    const double few = steps_with(3600);
    EXPECT_LT(steps_with(10), 1.15 * few) << beta;
    EXPECT_LT(steps_with(1), 1.15 * few) << beta;
  }
}

TEST_P(PassedOutputs, AreWithinTheTimeErrorOfAFinerRun) {
  const Curve varying = Curve::from_table(LinearTable({200, 500}, {700, 900}));
  for (const Curve& specific_heat : {Curve(800.0), varying}) {
    for (const double beta : {1.0, 1e3, 1e6}) {
      const HeatModel model = heated_pair(400, beta, specific_heat);
      Followed coarse;
      EXPECT_LT(off_over_time_error(model, GetParam(), coarse), 1) << beta;
      EXPECT_LT(coarse.states.size(), coarse.times.size() / 3) << "steps have passed outputs";
    }
  }
}

// Heat is taken up evenly, so that steps are exact however long they are: its integral over c tells the temperature.
TEST_P(PassedOutputs, AreWithinTheTimeErrorWhereASpecificHeatKinks) {
  constexpr double power = 1.8e5;  // [W/m3]
  const Curve specific_heat = Curve::from_table(LinearTable({250, 507, 1300}, {2000, 1086, 600}));
  const auto mesh = test::slab_mesh<2>({bar<2>(0.1, 4, 1, 0.05)});
  HeatOptions options = test::options_for(mesh, 300);
  options.sources.push_back({test::on(BodyId{0}, std::nullopt), power, "source", {}});
  Table<MaterialId, Material> materials = test::rock_only();
  materials[MaterialId{0}].specific_heat = specific_heat;
  const HeatModel model = make_heat_model(mesh, materials, contact::ContactSet<2>{}, options);
  HeatRun run(model, two_hours(20, GetParam()));
  const Followed followed = follow(run);
  EXPECT_TRUE(run.within_tolerance());
  for (std::size_t i = 0; i < followed.times.size(); ++i) {
    const double taken_up = specific_heat.integral(followed.temperatures[i].mean()) - specific_heat.integral(300);  // [J/kg]
    const double given = power * followed.times[i] / test::rock().density.value();
    const double capacity = specific_heat(followed.temperatures[i].mean());
    EXPECT_LE(std::abs(taken_up - given) / capacity, run.state().time_error + 1e-9) << followed.times[i];
  }
}

// A formula of place and time is looked at less often than one of time alone, and cannot be a table.
TEST_P(PassedOutputs, AreNotPassedByAPulseAfterALongQuietThatTheyCouldShow) {
  const HeatModel model = heated_pair(test::formula("300 + (200 + x)*exp(-((t/3600 - 703)/2)^2)"), 10);
  TimeOptions options = two_hours(3600, GetParam());
  options.until = 1000 * 3600.0;
  HeatRun run(model, options);
  run.advance_to(options.until);
  EXPECT_TRUE(run.within_tolerance());
  EXPECT_NEAR(run.state().reached.largest, 500, 10);
  EXPECT_LT(run.state().steps, 500);
}

TEST_P(PassedOutputs, ARunThatGoesOnFromAStateRepeatsThemToTheBit) {
  const HeatModel model = heated_pair(400, 100);
  const TimeOptions options = two_hours(20, GetParam());
  const auto file = scree::test::temp_folder() / "passed.h5";
  HeatRun whole(model, options);
  const Followed followed = follow(whole);
  for (const HeatState& state : followed.states) {
    write(state, "key", file);
    HeatRun resumed(model, options, read_state(file, "key"));
    const Followed rest = follow(resumed);
    const std::size_t before = followed.times.size() - rest.times.size();
    for (std::size_t i = 0; i < rest.times.size(); ++i) {
      ASSERT_EQ(rest.times[i], followed.times[before + i]);
      ASSERT_EQ(rest.temperatures[i], followed.temperatures[before + i]) << state.time << ' ' << rest.times[i];
    }
  }
}

// Looked for over the longer time that outputs need to be smooth, the pulse lies between two looks; over the step's, it does
// not.
TEST(Outputs, BesideAPulseThatOnlyOneOfTwoLooksSeesAreWithinTheTolerance) {
  const auto mesh = test::slab_mesh<2>({bar<2>(1, 20, 2, 0.1)});
  const auto temperatures = [&](double tolerance) {
    HeatOptions options = test::options_for(mesh, 293.15);
    options.boundaries.push_back(test::hold(BodyId{0}, 0, 373.15, "hot"));
    Boundary pulse;
    pulse.region = test::on(BodyId{0}, test::between_x(1, 1));
    pulse.condition = HeatFlux{test::formula("(t > 83048 && t < 83052) ? 1000 : 0")};
    pulse.name = "pulse";
    options.boundaries.push_back(pulse);
    TimeOptions time;
    time.until = 200000;
    time.output_every = 100;
    time.tolerance = tolerance;
    HeatRun run(make_heat_model(mesh, test::rock_only(), {}, options), time);
    return follow(run).temperatures;
  };
  const auto coarse = temperatures(0.5), fine = temperatures(0.01);
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_LT((coarse[i] - fine[i]).lpNorm<Eigen::Infinity>(), 0.5) << i;
}

TEST(Outputs, AreAllToldOnceAndInOrderWhateverTheInterval) {
  const HeatModel model = heated_pair(400, 1);
  for (const double every : {7.0, 30.0, 100.0, 2500.0, 9000.0}) {
    for (const Integrator integrator : {Integrator::automatic, Integrator::explicit_euler}) {
      HeatRun run(model, two_hours(every, integrator));
      std::vector<double> expected;
      for (int k = 1; k * every < 7200; ++k) expected.push_back(k * every);
      expected.push_back(7200);
      EXPECT_EQ(follow(run).times, expected);
      EXPECT_EQ(run.state().time, 7200);
    }
  }
}

TEST(Outputs, ComeOnceAtTheEndWhereIntervalsFillTheRunButForRounding) {
  for (const auto& [every, until] : {std::pair{0.7, 4.9}, {2.3, 16.1}, {0.1, 0.3}}) {
    TimeOptions options = two_hours(every);
    options.until = until;
    HeatRun run(heated_pair(400, 1), options);
    const Followed outputs = follow(run);
    EXPECT_EQ(outputs.times.size(), std::lround(until / every)) << every;
    EXPECT_EQ(outputs.times.back(), until) << every;
  }
}

TEST(Outputs, StillComeWhereARunGoesOnFromATimeBetweenThem) {
  const HeatModel model = heated_pair(400, 1);
  HeatRun run(model, two_hours(1000));
  run.advance_to(1700);
  EXPECT_EQ(run.state().time, 1700);
  EXPECT_EQ(follow(run).times, (std::vector<double>{2000, 3000, 4000, 5000, 6000, 7000, 7200}));
}

TEST_P(PassedOutputs, ArePassedBetweenTheBendsOfATableButNotAtThem) {
  const auto held = Function::from_table(LinearTable({0, 3600, 7200}, {400, 400, 330}), ValueRule{});
  const HeatModel model = heated_pair(held, 1);
  Followed followed;
  EXPECT_LT(off_over_time_error(model, GetParam(), followed), 1);
  const auto& states = followed.states;
  EXPECT_TRUE(std::any_of(states.begin(), states.end(), [](const HeatState& state) { return state.time == 3600; }));
  EXPECT_LT(states.size(), followed.times.size() / 2);
  for (std::size_t i = 0; i < followed.times.size(); ++i) {
    const double there = followed.temperatures[i][model.fixed_nodes.front().value()];
    EXPECT_DOUBLE_EQ(there, held(Eigen::Vector3d::Zero(), followed.times[i]));
  }
}

TEST_P(PassedOutputs, ArePassedWhereAFormulaDrivesThatIsSmooth) {
  const auto unit = std::get<UnitConverter>(unit_converter("K", quantity::temperature));
  for (const double beta : {1.0, 1e3}) {
    for (const std::string formula : {"350 + 40*sin(t/1500)", "400 - t/200", "320 + 60*exp(-t/2000)"}) {
      Followed followed;
      const HeatModel model = heated_pair(Function::from_expression(formula, unit, ValueRule{}), beta);
      EXPECT_LT(off_over_time_error(model, GetParam(), followed), 1) << formula;
      EXPECT_LT(followed.states.size(), 0.7 * static_cast<double>(followed.times.size())) << formula;
    }
  }
}

// Whether the bend is one that looks tell, or a rise that only gets steeper.
TEST_P(PassedOutputs, AreWithinTheTimeErrorWhereAFormulaBends) {
  const auto unit = std::get<UnitConverter>(unit_converter("K", quantity::temperature));
  for (const std::string formula : {"400 - max(0, t - 3590)/50", "350 + t/100 + max(0, t - 3010)/20", "350 + 40*(t > 3333)",
                                    "350 + 40*exp(-((t - 4000)/50)^2)"}) {
    Followed followed;
    const HeatModel model = heated_pair(Function::from_expression(formula, unit, ValueRule{}), 10);
    EXPECT_LT(off_over_time_error(model, GetParam(), followed), 1) << formula;
  }
}

TEST(Outputs, MakeARunKeepNoEndsOfStepsWhereNoneIsPassed) {
  const HeatModel model = heated_pair(400, 1);
  HeatRun one(model, two_hours(7200)), many(model, two_hours(20));
  follow(one);
  follow(many);
  EXPECT_TRUE(one.state().earlier.empty());
  EXPECT_EQ(many.state().earlier.size(), 3);
}

INSTANTIATE_TEST_SUITE_P(Each, PassedOutputs, ::testing::Values(Integrator::implicit, Integrator::stabilised_explicit),
                         [](const auto& of) { return of.param == Integrator::implicit ? "implicit" : "stabilised"; });

}  // namespace
}  // namespace scree::thermal
