#include "thermal/bent_storage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

HeatModel bar_of(const Curve& specific_heat) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 4, 2, 0.025)});
  Material rock = test::rock();
  rock.specific_heat = specific_heat;
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 300, "held"));
  return make_heat_model(mesh, Table<MaterialId, Material>({rock}), {}, options);
}

TEST(BentStorage, IsThereOnlyWhereASpecificHeatDependsOnTemperature) {
  EXPECT_FALSE(BentStorage(bar_of(800.0)));
  EXPECT_TRUE(BentStorage(bar_of(test::curve("500 + T"))));
}

TEST(BentStorage, FollowsTheEnthalpyToSecondOrder) {
  const HeatModel model = bar_of(test::curve("500 + T + 1e-3*(T - 300)^2"));
  BentStorage storage(model);
  storage.fit(HeatBalance(model), model.initial, capacity_at(model, model.initial), {});
  const Eigen::VectorXd capacity = capacity_at(model, model.initial);
  const Eigen::Index row = model.initial.size() - 1;
  const auto off = [&](double heat) {
    const Eigen::VectorXd stored = heat * capacity;
    const double warmer = HeatBalance(model).temperature_after(model.initial, stored, model.initial)[row] - model.initial[row];
    return std::abs(BentStorage::rise(storage.slope()[row], heat) - warmer);
  };
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NEAR(std::log2(off(sign * 16) / off(sign * 8)), 3, 0.1);
    EXPECT_NEAR(std::log2(off(sign * 8) / off(sign * 4)), 3, 0.05);
  }
}

TEST(BentStorage, GoesThroughTheEnthalpyBehindAKinkWhereTheNodeIsExpected) {
  const HeatModel model = bar_of(Curve::from_table(LinearTable({200, 302, 400}, {800, 800, 1000})));
  const HeatBalance balance(model);
  const Eigen::VectorXd way = Eigen::VectorXd::Constant(model.initial.size(), 5);
  const Eigen::VectorXd capacity = capacity_at(model, model.initial);
  const Eigen::Index row = model.initial.size() - 1;
  const double heat = balance.stored(model.initial, model.initial + way)[row] / capacity[row];
  BentStorage storage(model);
  storage.fit(balance, model.initial, capacity, {});
  EXPECT_GT(BentStorage::rise(storage.slope()[row], heat) - 5, 0.01) << "by the curve at the start";
  storage.fit(balance, model.initial, capacity, model.initial + way);
  EXPECT_NEAR(BentStorage::rise(storage.slope()[row], heat), 5, 1e-12);
}

// Against the mean by a thousand looks; and where nothing bends none is asked for.
TEST(BentStorage, TellsHowFarTemperaturesStrayFromTheParabolaOnTheirWay) {
  const HeatModel model = bar_of(Curve::from_table(LinearTable({200, 302, 302.5, 303, 400}, {800, 800, 1600, 800, 800})));
  const HeatBalance balance(model);
  const Eigen::VectorXd way = Eigen::VectorXd::Constant(model.initial.size(), 5);
  const Eigen::VectorXd capacity = capacity_at(model, model.initial);
  const Eigen::VectorXd taken_up = balance.stored(model.initial, model.initial + way);
  const Eigen::VectorXd heat = taken_up.cwiseQuotient(capacity);
  BentStorage storage(model);
  storage.fit(balance, model.initial, capacity, model.initial + way);
  const Eigen::VectorXd stray = storage.stray(balance, model.initial, heat, taken_up, way, 1e-3);
  ASSERT_EQ(stray.size(), way.size());
  const Eigen::Index row = way.size() - 1;
  const auto beside = [&](double part) {
    const Eigen::VectorXd stored = part * taken_up;
    const double warmer = balance.temperature_after(model.initial, stored, model.initial)[row] - model.initial[row];
    return warmer - BentStorage::rise(storage.slope()[row], part * heat[row]);
  };
  double mean = -beside(1) / 3;
  for (int i = 0; i < 1000; ++i) mean += beside((i + 0.5) / 1000) / 1000;
  EXPECT_GT(std::abs(mean), 0.01);
  EXPECT_NEAR(stray[row], mean, 0.05 * std::abs(mean));
  for (const NodeId node : model.fixed_nodes) EXPECT_EQ(stray[node.value()], 0);
  EXPECT_EQ(storage.stray(balance, model.initial, heat, taken_up, way, 10).size(), 0);
}

// Steps grow as it comes to rest, and what it did in the step before would lead beyond the air's 449 K, and 450.
TEST(BentStorage, AsksNoFormulaBeyondWhereTemperaturesHaveBeen) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.05, 2, 1, 0.025)});
  Material metal = test::rock();
  metal.density = 2000;
  metal.conductivity = 45.0;
  metal.specific_heat = test::curve("50*sqrt(450 - T)");
  HeatOptions options = test::options_for(mesh, 400);
  Boundary end = test::hold(BodyId{0}, 0, 0, "end");
  end.condition = Convection{240, 449};
  options.boundaries.push_back(end);
  const HeatModel model = make_heat_model(mesh, Table<MaterialId, Material>({metal}), {}, options);
  TimeOptions time;
  time.until = 40000;
  time.output_every = 10000;
  time.tolerance = 5;
  time.integrator = Integrator::stabilised_explicit;
  HeatRun run(model, time);
  run.advance_to(time.until);
  EXPECT_TRUE(run.within_tolerance());
  EXPECT_NEAR(run.state().temperature.mean(), 449, 5);
}

TEST(BentStorage, LeavesFixedNodesAsWarmAsTheyAreHeld) {
  const HeatModel model = bar_of(test::curve("500 + T"));
  BentStorage storage(model);
  storage.fit(HeatBalance(model), model.initial, capacity_at(model, model.initial), {});
  ASSERT_FALSE(model.fixed_nodes.empty());
  for (const NodeId node : model.fixed_nodes) EXPECT_EQ(BentStorage::rise(storage.slope()[node.value()], 7), 7);
}

TEST(BentStorage, BendsNoMoreThanTheStagesAllowFor) {
  constexpr double most = BentStorage::most_bend;
  for (const double slope : {0.0, 1e-3, -1e-3, 0.5, -20.0}) {
    for (double heat = -100; heat < 100; heat += 0.125) {
      const double rise = BentStorage::rise(slope, heat);
      const double per_heat = (BentStorage::rise(slope, heat + 0.125) - rise) / 0.125;
      EXPECT_LE(std::abs(per_heat - 1), most * (1 + 1e-9)) << slope << " " << heat;
      if (std::abs(slope * heat) < most) {
        EXPECT_NEAR(rise, heat - 0.5 * slope * heat * heat, 1e-13) << slope << " " << heat;
      }
    }
  }
}

}  // namespace
}  // namespace scree::thermal
