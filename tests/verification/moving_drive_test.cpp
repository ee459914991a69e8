// Stabilised explicit steps under conditions that change in time (moving_drive.h), beside implicit ones.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "tests/verification/stabilised.h"
#include "thermal/drive.h"
#include "thermal/heat_run.h"
#include "thermal/rkl2.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {
namespace {

using test::after;
using test::formula;
using test::start_of;

// What acts on two bars with a joint: the left end is held, the right one in a wind and under a sky, the left bar heated.
struct Conditions {
  std::string name;
  std::string held = "350";
  std::string flow = "1e5";
  std::string air = "280";
  std::string wind = "20";
  std::string sky{};  // empty: nothing is radiated
  Curve conductivity = 2.0;
  Curve specific_heat = 800.0;
};

std::vector<Conditions> all_that_changes() {
  const std::string warmer = "(320 + 60*sin(t/90) + 200*x)";
  std::vector<Conditions> all(7);
  all[0].name = "held", all[0].held = warmer;
  all[1].name = "flow", all[1].flow = "1e5*sin(t/70)*(1 + x)";
  all[2].name = "air", all[2].air = warmer;
  all[3].name = "wind", all[3].wind = "20 + 15*sin(t/70)";
  all[4].name = "sky", all[4].sky = warmer;
  all[5] = {"everything", warmer, "1e5*sin(t/70)*(1 + x)", warmer, "20 + 15*sin(t/70)", warmer};
  all[6] = all[5];
  all[6].name = "everything, and properties", all[6].conductivity = test::curve("1 + 0.003*T");
  all[6].specific_heat = test::curve("400 + T");
  return all;
}

HeatModel driven_pair(const Conditions& conditions, double beta = 10) {
  auto right = test::bar<2>(0.05, 4, 2, 0.025);
  right.low[0] = 0.05;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.05, 4, 2, 0.025), right});
  Material rock = test::rock();
  rock.conductivity = conditions.conductivity;
  rock.specific_heat = conditions.specific_heat;
  HeatOptions options = test::options_for(mesh, 320);
  options.joint.law = StiffnessFactor{beta};
  Boundary end = test::hold(BodyId{0}, 0, 0, "held");
  end.condition = FixedTemperature{formula(conditions.held)};
  options.boundaries.push_back(end);
  end = test::hold(BodyId{1}, 0.1, 0, "wind");
  end.condition = Convection{formula(conditions.wind), formula(conditions.air)};
  options.boundaries.push_back(end);
  if (!conditions.sky.empty()) {
    end.name = "sky";
    end.condition = Radiation{0.9, formula(conditions.sky)};
    options.boundaries.push_back(end);
  }
  options.sources.push_back({test::on(BodyId{0}, std::nullopt), formula(conditions.flow), "heater", {}});
  return make_heat_model(mesh, Table<MaterialId, Material>({rock}), test::matching_contacts(mesh), options);
}

TEST(MovingDrive, StepsAreOfSecondOrderWhateverChangesInTime) {
  for (const Conditions& conditions : all_that_changes()) {
    const HeatModel model = driven_pair(conditions);
    const Instant smooth = after(*make_implicit_scheme(model), start_of(model), 200, 200);
    const auto scheme = make_stabilised_scheme(model);
    const Eigen::VectorXd exact = after(*make_implicit_scheme(model), smooth, 400, 8192).temperature;
    const auto error = [&](int count) { return (after(*scheme, smooth, 400, count).temperature - exact).norm(); };
    EXPECT_NEAR(std::log2(error(64) / error(128)), 2, 0.2) << conditions.name;
    EXPECT_NEAR(std::log2(error(128) / error(256)), 2, 0.1) << conditions.name;
  }
}

// With steps from far below to far above the fastest time scale of a joint.
TEST(MovingDrive, StepsKeepTheirToleranceAndTheirLedger) {
  for (const Conditions& conditions : all_that_changes()) {
    for (const double beta : {0.1, 100.0}) {
      test::expect_kept(driven_pair(conditions, beta), 1200, {3.0, 0.3, 0.03},
                        fmt::format("{}, beta {}", conditions.name, beta));
    }
  }
}

// In the ledger each flow is what implicit steps find, not only their sum.
// Both sides of a stiff joint follow the swing, each by its own enthalpy: 1.28 times as many along the tangent alone.
TEST(MovingDrive, ASpecificHeatThatRisesMakesHardlyMoreSteps) {
  const auto steps = [](const Curve& specific_heat) {
    Conditions swing{"swing", "350 + 40*sin(t/3600)", "0"};
    swing.specific_heat = specific_heat;
    TimeOptions time;
    time.until = 28800;
    time.output_every = 1200;
    time.tolerance = 0.1;
    time.integrator = Integrator::stabilised_explicit;
    HeatRun run(driven_pair(swing, 100), time);
    run.advance_to(time.until);
    return static_cast<double>(run.state().steps);
  };
  EXPECT_LE(steps(test::curve("720 + 0.8*(T - 250)")), 1.05 * steps(800.0));
}

TEST(MovingDrive, EachFlowOfTheLedgerIsThatOfImplicitSteps) {
  for (const Conditions& conditions : all_that_changes()) {
    const HeatModel model = driven_pair(conditions);
    TimeOptions time;
    time.until = 1200;
    time.output_every = 1200;
    time.tolerance = 0.01;
    const auto ledger = [&](Integrator integrator) {
      time.integrator = integrator;
      HeatRun run(model, time);
      run.advance_to(time.until);
      return run.state().ledger;
    };
    const Ledger a = ledger(Integrator::stabilised_explicit);
    const Ledger b = ledger(Integrator::implicit);
    const double small = 1e-4 * b.turnover;
    EXPECT_NEAR(a.by_boundary[0], b.by_boundary[0], small) << conditions.name;
    EXPECT_NEAR(a.by_applied[0], b.by_applied[0], small) << conditions.name;
    for (std::size_t e = 0; e < model.exchanges.size(); ++e) {
      EXPECT_NEAR(a.by_surroundings[e], b.by_surroundings[e], small) << conditions.name;
    }
    EXPECT_NEAR(a.turnover, b.turnover, 0.01 * b.turnover) << conditions.name;
  }
}

TEST(MovingDrive, AConditionThatIsSaidToChangeButStaysMakesNoDifference) {
  Conditions stays;
  stays.sky = "250";
  Conditions said = stays;
  for (std::string* text : {&said.held, &said.flow, &said.air, &said.wind, &said.sky}) *text += " + 0*t";
  const HeatModel one = driven_pair(stays);
  const HeatModel other = driven_pair(said);
  ASSERT_FALSE(varies_in_time(one));
  ASSERT_TRUE(varies_in_time(other));
  test::expect_equal_steps(one, other, 1e-11);
}

TEST(MovingDrive, StepsGoOnFromAFileToTheBit) {
  test::expect_stabilised_steps_resumed_to_the_bit(driven_pair(all_that_changes().back()), "moving drive");
}

TEST(MovingDrive, StabilisedStepsAreChosenWhereTheyCostLess) {
  TimeOptions time;
  time.until = 600;
  time.output_every = 100;
  for (const Conditions& conditions : all_that_changes()) {
    EXPECT_THAT(HeatRun(driven_pair(conditions, 0.1), time).solver(), testing::StartsWith("RKL2")) << conditions.name;
  }
}

// A node that nothing but a load acts on warms by the quadrature itself.
TEST(MovingDrive, TheDriveIsSummedWithTheWeightsOfTheScheme) {
  for (const int stages : {3, 5, 9, 33}) {
    const auto summed = [&](auto&& drive) {
      double older = 0;
      double newer = rkl2::first_coefficient(stages) * drive(0.0);
      for (int j = 2; j <= stages; ++j) {
        const rkl2::Coefficients with = rkl2::coefficients(j, stages);
        older = with.mu * newer + with.nu * older + (with.start - with.product) * drive(0.0) +
                with.product * drive(rkl2::part_at(j - 1, stages));
        std::swap(older, newer);
      }
      return newer;
    };
    const rkl2::DriveWeights weights = rkl2::drive_weights(stages);
    EXPECT_NEAR(weights.start + weights.middle + weights.end, summed([](double) { return 1; }), 1e-13) << stages;
    EXPECT_NEAR(0.5 * weights.middle + weights.end, summed([](double part) { return part; }), 1e-13) << stages;
    EXPECT_NEAR(0.25 * weights.middle + weights.end, summed([](double part) { return part * part; }), 1e-13) << stages;
    EXPECT_NEAR(rkl2::part_at(stages, stages), summed([](double) { return 1; }), 1e-13) << "the last stage is the step's end";
  }
}

}  // namespace
}  // namespace scree::thermal
