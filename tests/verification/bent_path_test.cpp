// What steps say of their time error where c or k bends within a step (bent_path.h, enthalpy_scheme.cpp, and held temperatures
// in stabilised_scheme.cpp).
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

Curve table(std::vector<double> places, std::vector<double> values) {
  return Curve::from_table(LinearTable(std::move(places), std::move(values)));
}

// Two bars, joined; the left one is heated at its left end by a condition.
HeatModel pair_with(const Material& rock, double size, int cells, double initial, double beta,
                    const decltype(Boundary::condition)& condition) {
  auto right = test::bar<2>(size, cells, 1, size / cells);
  right.low[0] = size;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(size, cells, 1, size / cells), right});
  HeatOptions options = test::options_for(mesh, initial);
  options.joint.law = StiffnessFactor{beta};
  Boundary end = test::hold(BodyId{0}, 0, 0, "end");
  end.condition = condition;
  options.boundaries.push_back(end);
  return make_heat_model(mesh, Table<MaterialId, Material>({rock}), test::matching_contacts(mesh), options);
}

std::vector<Eigen::VectorXd> outputs_of(HeatRun& run) {
  std::vector<Eigen::VectorXd> all;
  run.follow([&](const HeatRun::Output& output) { all.push_back(output.temperature); });
  return all;
}

// Beside steps of the other kind at a tolerance of a hundredth.
void expect_true_claims(const HeatModel& model, TimeOptions time, const std::vector<double>& tolerances,
                        const std::string& name, Integrator integrator = Integrator::implicit) {
  const bool implicit = integrator == Integrator::implicit;
  time.integrator = implicit ? Integrator::stabilised_explicit : Integrator::implicit;
  time.tolerance = 0.01 * *std::min_element(tolerances.begin(), tolerances.end());
  HeatRun exact(model, time);
  const auto expected = outputs_of(exact);
  time.integrator = integrator;
  for (const double tolerance : tolerances) {
    time.tolerance = tolerance;
    HeatRun run(model, time);
    const auto found = outputs_of(run);
    ASSERT_EQ(found.size(), expected.size());
    double error = 0;
    for (std::size_t i = 0; i < found.size(); ++i) error = std::max(error, (found[i] - expected[i]).lpNorm<Eigen::Infinity>());
    EXPECT_LE(error, run.state().time_error) << name << " " << tolerance;
    EXPECT_TRUE(run.within_tolerance()) << name << " " << tolerance << ", claims " << run.state().time_error;
  }
}

// Wet ground whose ice melts within 2 K, at corners 0.01 K wide: c changes there by 28 and 40 times, and with it the
// temperature that the heat of an error is worth.
TEST(BentPath, OfGroundThatThawsIsSeenWhereverStepsMeetTheCornersOfItsCurve) {
  constexpr double zero = 273.15;
  Material ground = test::rock();
  ground.density = 1800;
  ground.conductivity = table({zero - 40, zero - 2, zero, zero + 100}, {2.4, 2.2, 1.3, 1.3});
  ground.specific_heat =
      table({zero - 40, zero - 2, zero - 1.99, zero - 0.01, zero, zero + 100}, {1000, 1000, 40000, 40000, 1400, 1400});
  TimeOptions time;
  time.until = 86400;
  time.output_every = 7200;
  for (const double beta : {10.0, 1000.0}) {
    expect_true_claims(pair_with(ground, 0.2, 20, zero - 8, beta, Convection{15, zero + 12}), time, {0.1, 0.05, 0.02},
                       "beta " + std::to_string(beta));
  }
}

// An error of a node whose ice just melts grows 220 times when that is over. With the same care for all nodes these runs ended
// 14 to 60 times above their tolerance.
TEST(BentPath, OfGroundThatFreezesAndThawsStaysWithinTheToleranceBehindThePeakOfItsCurve) {
  Material ground = test::rock();
  ground.density = 1800;
  ground.conductivity = 1.5;
  ground.specific_heat = table({200, 270.2, 272.2, 273.2, 400}, {900, 900, 200000, 1300, 1300});
  TimeOptions time;
  time.until = 3 * 86400;
  time.output_every = 21600;
  const Convection air{15, test::formula("265 + 25*sin(2*pi*t/20000)")};
  for (const Integrator integrator : {Integrator::stabilised_explicit, Integrator::implicit}) {
    expect_true_claims(pair_with(ground, 0.26, 13, 272, 10, air), time, {0.5, 0.02}, "freezing", integrator);
  }
}

// Within half a kelvin c falls by a third and rises by two thirds, in the middle of a step at whose ends it is nearly the same.
TEST(BentPath, OfADipThatAStepGoesOverIsSeen) {
  Material rock = test::rock();
  rock.density = 1900;
  rock.conductivity = 3.9;
  rock.specific_heat = table({300, 373, 421, 421.45, 421.6, 700}, {1380, 1380, 1190, 845, 1395, 1395});
  TimeOptions time;
  time.until = 12000;
  time.output_every = 600;
  for (const double warm : {500.0, 600.0, 700.0}) {
    expect_true_claims(pair_with(rock, 0.2, 10, 360, 100, Convection{15, warm}), time, {0.05, 0.02, 0.01},
                       "dip " + std::to_string(warm));
  }
}

// The held end drives the rock by the integral of k, which is no parabola between the times at which a step looks at it.
TEST(BentPath, OfAHeldTemperatureIsThatOfItsPotential) {
  Material rock = test::rock();
  rock.density = 2000;
  rock.specific_heat = 900;
  rock.conductivity = table({200, 300, 320, 600}, {3, 3, 0.5, 0.5});
  TimeOptions time;
  time.until = 3000;
  time.output_every = 1000;
  expect_true_claims(pair_with(rock, 0.1, 5, 300, 1e5, FixedTemperature{test::formula("340 + 60*sin(0.03*t)")}), time,
                     {1.0, 0.3, 0.1}, "swing");
  rock.conductivity = table({200, 300, 320, 600}, {1, 3, 0.5, 4});
  for (const char* swing : {"340 + 60*sin(0.0812552*t)", "340 + 60*sin(0.03*t)"}) {
    expect_true_claims(pair_with(rock, 0.1, 5, 300, 10, FixedTemperature{test::formula(swing)}), time, {1.0, 0.5, 0.3, 0.1},
                       swing, Integrator::stabilised_explicit);
  }
}

}  // namespace
}  // namespace scree::thermal
