// The scenes of convection, radiation, properties over temperature and steady states, against series and published values.

#include <cmath>
#include <functional>

#include <gmock/gmock.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

constexpr double celsius = 273.15;

// The root of a function that rises from low to high.
double root(const std::function<double(double)>& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// (T - T_s)/(T_0 - T_s) of a plane wall of thickness L, Incropera and others, eq. (5.39): x* = x/L, Fo = a t/L^2.
double wall(double place, double fourier, double biot) {
  double sum = 0;
  for (int n = 0; n < 60; ++n) {
    const double z = root([&](double v) { return v * std::tan(v) - biot; }, n * M_PI, n * M_PI + M_PI / 2 - 1e-12);
    sum += 4 * std::sin(z) / (2 * z + std::sin(2 * z)) * std::exp(-z * z * fourier) * std::cos(z * place);
  }
  return sum;
}

// The same of a ball of radius R, eq. (5.42): r* = r/R, Fo = a t/R^2.
double ball(double place, double fourier, double biot) {
  double sum = 0;
  for (int n = 0; n < 60; ++n) {
    const double z = root([&](double v) { return 1 - v / std::tan(v) - biot; }, n * M_PI + 1e-9, (n + 1) * M_PI - 1e-9);
    const double weight = 4 * (std::sin(z) - z * std::cos(z)) / (2 * z - std::sin(2 * z));
    sum += weight * std::exp(-z * z * fourier) * (place == 0 ? 1 : std::sin(z * place) / (z * place));
  }
  return sum;
}

TEST(ConvectionSlab, FollowsTheSeriesOfAPlaneWall) {
  const SceneRun run = test::run("convection_slab", fresh_directory("convection_slab"));
  ASSERT_EQ(run.exit_status, 0);
  const auto columns = run.probes();
  const auto& time = columns.at("time");
  ASSERT_EQ(time.size(), 13u);
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double fourier = 2.0 / 2000 / 1000 * time[i] / 0.01;
    EXPECT_NEAR(columns.at("inside")[i] - celsius, 20 + 80 * wall(0, fourier, 1), 0.05) << time[i];
    EXPECT_NEAR(columns.at("middle")[i] - celsius, 20 + 80 * wall(0.5, fourier, 1), 0.05) << time[i];
    EXPECT_NEAR(columns.at("outside")[i] - celsius, 20 + 80 * wall(1, fourier, 1), 0.1) << time[i];
  }
  EXPECT_LT(run.summary["heat"]["ledger_residual"], 1e-8);
}

TEST(CoolingSphere, FollowsTheSeriesOfABall) {
  const SceneRun run = test::run("cooling_sphere", fresh_directory("cooling_sphere"));
  ASSERT_EQ(run.exit_status, 0);
  const auto columns = run.probes();
  const auto& time = columns.at("time");
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double fourier = 2.0 / 2500 / 800 * time[i] / 0.0025;
    EXPECT_NEAR(columns.at("centre")[i], 300 + 100 * ball(0, fourier, 0.5), 1.5) << time[i];
    EXPECT_NEAR(columns.at("halfway")[i], 300 + 100 * ball(0.5, fourier, 0.5), 1.5) << time[i];
  }
  EXPECT_LT(columns.at("centre").back(), 330);
}

TEST(RadiatingBar, EndsAtTheTemperatureOfNafemsT2) {
  const SceneRun run = test::run("radiating_bar", fresh_directory("radiating_bar"));
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_NEAR(run.summary["heat"]["probes"]["end"]["temperature"], 927.0, 0.1);
  EXPECT_TRUE(std::filesystem::exists(run.directory / "heat.pvd"));
}

// Of the ground at this height [m] and time [s]: Carslaw and Jaeger, section 2.6, in degrees Celsius.
double daily_wave(double height, double time) {
  const double conductivity = 2.6;
  const double coefficient = 20;
  const double rate = 2 * M_PI / 86400;
  const double depth = std::sqrt(2 * conductivity / (2600 * 1000) / rate);
  const double b = conductivity / (coefficient * depth);
  const double lag = std::atan(b / (1 + b));
  const double amplitude = 10 / std::sqrt(1 + 2 * b + 2 * b * b);
  return 10 + amplitude * std::exp(height / depth) * std::sin(rate * time + height / depth - lag);
}

TEST(DayAndNight, IsTheWaveThatFadesAndComesLaterWithDepthWhateverTheSteps) {
  for (const std::string integrator : {"automatic", "implicit"}) {
    const SceneRun run = test::run("day_and_night", fresh_directory("day_" + integrator), {"heat.integrator=" + integrator});
    ASSERT_EQ(run.exit_status, 0);
    const auto columns = run.probes();
    const auto& time = columns.at("time");
    ASSERT_EQ(time.size(), 73u);
    for (std::size_t i = 0; i < time.size(); ++i) {
      for (const auto& [probe, height] : {std::pair("surface", 0.0), {"at_10_cm", -0.1}, {"at_30_cm", -0.3}}) {
        EXPECT_NEAR(columns.at(probe)[i] - celsius, daily_wave(height, time[i]), 0.012) << probe << " " << time[i];
        EXPECT_NEAR(columns.at(std::string(probe) + " exact")[i] - celsius, daily_wave(height, time[i]), 1e-5) << time[i];
      }
    }
    const std::string solver = run.summary["heat"]["solver"];
    EXPECT_EQ(solver.find("RKL2") == 0, integrator == "automatic") << solver;
    EXPECT_LT(run.summary["heat"]["ledger_residual"], 1e-8);
  }
}

TEST(ShakenBar, ReachesTheTemperatureOfNafemsT3) {
  const SceneRun run = test::run("shaken_bar", fresh_directory("shaken_bar"));
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_NEAR(run.probes().at("target").back() - celsius, 36.60, 0.1);
}

TEST(ShakenBar, ATableOfTheSineIsAsGoodAsItsFormula) {
  std::string table = "heat.boundaries[1].temperature={table: [";
  for (int i = 0; i <= 128; ++i) {
    table += (i == 0 ? "[" : ", [") + std::to_string(0.25 * i) + ", " +
             std::to_string(celsius + 100 * std::sin(M_PI * 0.25 * i / 40)) + "]";
  }
  const SceneRun run = test::run("shaken_bar", fresh_directory("shaken_bar_table"), {table + "]}"});
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_NEAR(run.probes().at("target").back() - celsius, 36.60, 0.1);
}

TEST(CooledPlate, HasTheTemperatureOfNafemsT4) {
  const SceneRun run = test::run("cooled_plate", fresh_directory("cooled_plate"));
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_NEAR(double(run.summary["heat"]["probes"]["target"]["temperature"]) - celsius, 18.25, 0.2);
}

// The middle of a rectangle a x b with a source q and cold edges: Fourier series in the direction of a.
double heated_rectangle(double a, double b, double k, double q) {
  double sum = 0;
  for (int n = 1; n < 60; n += 2) {
    const double sign = n % 4 == 1 ? 1 : -1;
    sum += sign / (std::pow(n, 3) * std::cosh(n * M_PI * b / (2 * a)));
  }
  return q * a * a / (8 * k) * (1 - 32 / std::pow(M_PI, 3) * sum);
}

TEST(GrainOfWood, TheMiddleIsThatOfAPlateTwiceAsLong) {
  const double exact = 20 + celsius + heated_rectangle(0.2, 0.4, 0.4, 1000);
  for (const char* angle : {"0 deg", "90 deg"}) {
    const SceneRun run = test::run("grain_of_wood", fresh_directory("grain_of_wood"),
                                   {std::string("materials.wood.conductivity.rotation.angle=") + angle});
    ASSERT_EQ(run.exit_status, 0);
    EXPECT_NEAR(run.summary["heat"]["probes"]["middle"]["temperature"], exact, 0.05) << angle;
  }
}

TEST(HotRock, IsStraightInKirchhoffsTransform) {
  const SceneRun run = test::run("hot_rock", fresh_directory("hot_rock"));
  ASSERT_EQ(run.exit_status, 0);
  const auto exact = [](double x) { return 300 * std::pow(1300.0 / 300, x); };
  const auto& probes = run.summary["heat"]["probes"];
  EXPECT_NEAR(probes["quarter"]["temperature"], exact(0.25), 1);
  EXPECT_NEAR(probes["middle"]["temperature"], exact(0.5), 1);
  EXPECT_NEAR(probes["three_quarters"]["temperature"], exact(0.75), 1);
}

TEST(BarsAndJoint, TheSteadyStateIsTheEndOfALongRun) {
  const SceneRun in_time =
      test::run("bars_and_joint", fresh_directory("bars_in_time"), {"heat.until=72 h", "output.every=12 h"});
  const SceneRun steady = test::run("bars_and_joint", fresh_directory("bars_steady"),
                                    {"heat.steady=true", "heat.until=null", "heat.tolerance=null", "output.every=null"});
  ASSERT_EQ(steady.exit_status, 0);
  for (const char* probe : {"left_of_joint", "right_of_joint"}) {
    EXPECT_NEAR(steady.summary["heat"]["probes"][probe]["temperature"],
                double(in_time.summary["heat"]["probes"][probe]["temperature"]), 0.02);
  }
}

TEST(Slab, AStartFromAnEarlierRunGoesOnAsIfThereWereNoStop) {
  const auto first = fresh_directory("slab_first");
  ASSERT_EQ(test::run("slab", first).exit_status, 0);
  const SceneRun second = test::run("slab", fresh_directory("slab_second"),
                                    {"heat.initial={from: " + first.string() + ", time: 30 s}", "heat.until=30 s"});
  ASSERT_EQ(second.exit_status, 0);
  const SceneRun other_mesh =
      test::run("slab", fresh_directory("slab_other"),
                {"heat.initial={from: " + first.string() + ", time: 30 s}", "heat.until=30 s", "bodies.bar.mesh_size=0.008"});
  ASSERT_EQ(other_mesh.exit_status, 0);
  for (const char* probe : {"near", "middle", "far"}) {
    const double whole = SceneRun{0, first, {}}.probes().at(probe).back();
    EXPECT_NEAR(second.probes().at(probe).back(), whole, 0.02) << probe;
    EXPECT_NEAR(other_mesh.probes().at(probe).back(), whole, 0.1) << probe;
  }
}

}  // namespace
}  // namespace scree::test
