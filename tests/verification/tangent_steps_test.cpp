// Stabilised explicit steps where properties depend on temperature or heat is radiated (stabilised_scheme.cpp).
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "tests/verification/stabilised.h"
#include "thermal/drive.h"
#include "thermal/heat_run.h"
#include "thermal/stable_step.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {
namespace {

using test::after;
using test::start_of;

struct Rock {
  const char* name;
  Curve conductivity;
  Curve specific_heat;
  bool smooth = true;
};

Curve table(std::vector<double> places, std::vector<double> values) {
  return Curve::from_table(LinearTable(std::move(places), std::move(values)));
}

// Ice in the pores: a tenth of the mass takes up its latent heat over 4 K.
Curve melting() {
  return table({271, 273, 275}, {800, 17500, 800});
}

std::vector<Rock> rocks() {
  return {{"constant", 2.0, 800.0},
          {"c of a table", 2.0, table({200, 400, 900}, {600, 900, 1200}), false},
          {"c of a formula", 2.0, test::curve("400 + T")},
          {"k of a table", table({200, 400, 900}, {4, 2, 1}), 800.0},
          {"both of formulas", test::curve("1 + 0.01*T"), test::curve("400 + T")}};
}

Table<MaterialId, Material> of(const Rock& rock) {
  Material material = test::rock();
  material.conductivity = rock.conductivity;
  material.specific_heat = rock.specific_heat;
  return Table<MaterialId, Material>({material});
}

// Two bars with a joint; the left end is hot, the right one radiates and convects.
HeatModel radiating_pair(const Rock& rock, double beta = 10) {
  auto right = test::bar<2>(0.05, 4, 2, 0.025);
  right.low[0] = 0.05;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.05, 4, 2, 0.025), right});
  HeatOptions options = test::options_for(mesh, 500);
  options.joint.law = StiffnessFactor{beta};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 700, "hot"));
  Boundary end = test::hold(BodyId{1}, 0.1, 0, "sky");
  end.condition = Radiation{0.9, 250};
  options.boundaries.push_back(end);
  end.name = "wind";
  end.condition = Convection{20, 280};
  options.boundaries.push_back(end);
  return make_heat_model(mesh, of(rock), test::matching_contacts(mesh), options);
}

TEST(TangentSteps, AreOfSecondOrderWhateverDependsOnTemperature) {
  for (const Rock& rock : rocks()) {
    if (!rock.smooth) continue;  // a table has kinks
    const HeatModel model = radiating_pair(rock);
    const Instant smooth = after(*make_implicit_scheme(model), start_of(model), 200, 200);
    const auto scheme = make_stabilised_scheme(model);
    const Eigen::VectorXd exact = after(*make_implicit_scheme(model), smooth, 400, 4096).temperature;
    const auto error = [&](int count) { return (after(*scheme, smooth, 400, count).temperature - exact).norm(); };
    EXPECT_NEAR(std::log2(error(128) / error(256)), 2, 0.2) << rock.name;
    EXPECT_NEAR(std::log2(error(256) / error(512)), 2, 0.1) << rock.name;
  }
}

TEST(TangentSteps, KeepTheirToleranceAndTheirLedger) {
  for (const Rock& rock : rocks()) {
    for (const double beta : {0.1, 100.0}) test::expect_kept(radiating_pair(rock, beta), 600, {1.0, 0.1}, rock.name);
  }
}

TEST(TangentSteps, KeepTheirToleranceWhereSomethingMelts) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 8, 2, 0.025)});
  HeatOptions options = test::options_for(mesh, 260);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 300, "warm"));
  test::expect_kept(make_heat_model(mesh, of({"melting", 2.0, melting()}), {}, options), 4000, {1.0, 0.1}, "melting");
}

TEST(TangentSteps, AreThoseOfConstantPropertiesWhereNothingBends) {
  const HeatModel constant = radiating_pair({"constant", 2.0, 800.0});
  const HeatModel flat = radiating_pair({"flat", table({200, 900}, {2, 2}), table({200, 900}, {800, 800})});
  ASSERT_TRUE(flat.varying && flat.varying->unit_conductance.nonZeros() > 0);
  test::expect_equal_steps(constant, flat, 1e-10);
}

TEST(TangentSteps, GoOnFromAFileToTheBit) {
  test::expect_stabilised_steps_resumed_to_the_bit(radiating_pair(rocks().back()), "along the tangent");
}

TEST(TangentSteps, AreChosenWhereTheyCostLess) {
  const auto solver = [](double beta) {
    TimeOptions time;
    time.until = 600;
    time.output_every = 100;
    return HeatRun(radiating_pair(rocks().back(), beta), time).solver();
  };
  EXPECT_THAT(solver(0.1), testing::HasSubstr("along the tangent"));
  EXPECT_THAT(solver(1e7), testing::HasSubstr("Newton's iteration"));
}

// The matrix is symmetric where only the specific heat depends on temperature, and else one near it is factorised.
TEST(TangentSteps, AreLeftForImplicitOnesWhereJointsAreStiffWhateverDependsOnTemperature) {
  auto right = test::bar<3>(0.1, 10, 5, 0.1);
  right.low[0] = 0.1;
  const auto mesh = test::slab_mesh<3>({test::bar<3>(0.1, 10, 5, 0.1), right});
  HeatOptions options = test::options_for(mesh, 500);
  options.joint.law = StiffnessFactor{1000};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 700, "hot"));
  const auto solver = [&](const Rock& rock) {
    TimeOptions time;
    time.until = 36000;
    time.output_every = 600;
    return HeatRun(make_heat_model(mesh, of(rock), test::matching_contacts(mesh), options), time).solver();
  };
  EXPECT_THAT(solver({"c of a formula", 2.0, test::curve("400 + T")}), testing::HasSubstr("Newton's iteration"));
  EXPECT_THAT(solver({"both of formulas", test::curve("1 + 0.01*T"), test::curve("400 + T")}),
              testing::HasSubstr("Newton's iteration"));
}

// The magnitudes of J, whatever the temperatures are.
TEST(StableSteps, AreBoundedAtEveryTemperatureByTheLargestEigenvalue) {
  for (const Rock& rock : rocks()) {
    const HeatModel model = radiating_pair(rock);
    const StableSteps steps(model);
    const HeatBalance balance(model);
    for (const double warmer : {0.0, -200.0, 300.0}) {
      const Eigen::VectorXd temperature = model.initial.array() + warmer * model.places.row(0).transpose().array() / 0.1;
      const Linearised state = balance.linearised(temperature, Drives(model).at(0));
      Eigen::MatrixXd magnitudes = Eigen::MatrixXd(model.conductance).cwiseAbs();
      if (state.conductivity.size() > 0) {
        magnitudes += Eigen::MatrixXd(model.varying->unit_conductance).cwiseAbs() * state.conductivity.asDiagonal();
      }
      magnitudes.diagonal() += state.loss;
      Eigen::VectorXd inverse = state.capacity.cwiseInverse();
      for (const NodeId node : model.fixed_nodes) inverse[node.value()] = 0;
      const Eigen::MatrixXd rates = inverse.asDiagonal() * magnitudes;
      const double largest = rates.eigenvalues().cwiseAbs().maxCoeff();
      EXPECT_LE(steps.at(state), (1 + 1e-12) * 2 / largest) << rock.name << " " << warmer;
      EXPECT_GE(steps.at(state), 0.6 * 2 / largest) << rock.name << " " << warmer;
    }
  }
}

TEST(TemperatureAfter, HeatIsThatWhichStoresItWhereverItIsLookedFor) {
  std::vector<Rock> all = rocks();
  all.push_back({"melting", 2.0, melting()});
  all.push_back({"jump", 2.0, test::curve("T < 300 ? 500 : 2000")});
  for (const Rock& rock : all) {
    const HeatModel model = radiating_pair(rock);
    const HeatBalance balance(model);
    for (const double from : {10.0, 272.0, 299.0, 500.0, 3000.0}) {
      for (const double to : {1.0, 272.9, 301.0, 1500.0}) {
        const auto all_at = [&](double t) { return Eigen::VectorXd::Constant(model.initial.size(), t).eval(); };
        const Eigen::VectorXd heat = balance.stored(all_at(from), all_at(to));
        for (const double guess : {from, to, 280.0, 2000.0}) {
          const Eigen::VectorXd found = balance.temperature_after(all_at(from), heat, all_at(guess));
          EXPECT_LT((found.array() - to).abs().maxCoeff(), 1e-12 * (from + to)) << rock.name << " " << from << " " << to;
        }
      }
    }
  }
}

}  // namespace
}  // namespace scree::thermal
