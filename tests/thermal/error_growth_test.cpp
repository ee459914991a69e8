// What errors may become where a specific heat falls, against the ratio of capacities.
#include "thermal/error_growth.h"

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

HeatModel bar_of(const Curve& specific_heat) {
  Material rock = test::rock();
  rock.specific_heat = specific_heat;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(1, 4, 1, 0.25)});
  return make_heat_model(mesh, Table<MaterialId, Material>({rock}), contact::ContactSet<2>(), test::options_for(mesh, 300));
}

TemperatureRange between(double least, double largest) {
  TemperatureRange range;
  range.include(Eigen::Vector2d(least, largest));
  return range;
}

// 1 mK in the first node and 2 mK, of the other sign, in the last; they are at 300 and 350 K.
double largest_in(const ErrorGrowth& growth, const HeatModel& model) {
  Eigen::VectorXd error = Eigen::VectorXd::Zero(model.capacity.size()), temperature = error;
  temperature.setConstant(300);
  error[0] = 1e-3;
  error[error.size() - 1] = -2e-3;
  temperature[error.size() - 1] = 350;
  return ErrorGrowth::largest(error, growth.at(temperature));
}

TEST(ErrorGrowth, OfConstantCapacitiesThereIsNone) {
  const HeatModel model = bar_of(900);
  ErrorGrowth growth(model);
  growth.include(between(200, 400));
  EXPECT_EQ(largest_in(growth, model), 2e-3);
}

TEST(ErrorGrowth, IsThatFromAPeakToTheLeastCapacityWithinTheRange) {
  const HeatModel model =
      bar_of(Curve::from_table(LinearTable({200, 250, 290, 300, 310, 400}, {100, 800, 1000, 20000, 1000, 1000})));
  ErrorGrowth growth(model);
  growth.include(between(290, 350));
  EXPECT_NEAR(largest_in(growth, model), 20e-3, 1e-12) << "20,000 to 1,000";
  growth.include(between(250, 300));
  EXPECT_NEAR(largest_in(growth, model), 25e-3, 1e-12) << "20,000 to 800";
  growth.include(between(280, 300));
  EXPECT_NEAR(largest_in(growth, model), 25e-3, 1e-12) << "a range is never narrowed";
}

TEST(ErrorGrowth, WhatAStepAddsCountsByHowMuchItMakesTheErrorOfAnyNodeLarger) {
  const Eigen::VectorXd none;
  const Eigen::Vector3d error(3, -2, -1);
  EXPECT_EQ(ErrorGrowth::largest_rise(error, Eigen::Vector3d(1, 1, 0), none), 1) << "from 2 to 3, and from -3 to -2";
  EXPECT_EQ(ErrorGrowth::largest_rise(error, Eigen::Vector3d(-1, 1, 1), none), 0) << "from 4 to 3, -3 to -2, -2 to -1";
  EXPECT_EQ(ErrorGrowth::largest_rise(error, Eigen::Vector3d(0, 0, -4), none), -0.0) << "from 3 to -1";
  EXPECT_EQ(ErrorGrowth::largest_rise(error, Eigen::Vector3d(1, -2, 0), Eigen::Vector3d(1, 5, 1)), 10)
      << "5 times from 0 to -2";
}

// Heat is led fast to nodes that lead it slowly: an error that comes there is worth more kelvin, whatever the steps. Those were
// halved for it, half of them in vain.
TEST(ErrorGrowth, ByItselfShortensNoStep) {
  Material rock = test::rock();
  rock.density = 1174;
  rock.conductivity = Curve::from_table(LinearTable({200, 350, 382, 414, 900}, {1, 1, 12, 1, 1}));
  rock.specific_heat = Curve::from_table(LinearTable({200, 300, 326.5, 353, 900}, {500, 500, 5200, 500, 500}));
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.2, 10, 1, 0.02)});
  HeatOptions options = test::options_for(mesh, 285);
  Boundary end = test::hold(BodyId{0}, 0, 0, "end");
  end.condition = FixedTemperature{
      Function::from_table(LinearTable({0, 50, 412, 634, 645, 705, 1400}, {362, 420, 389, 376, 443, 282, 432}), ValueRule{})};
  options.boundaries.push_back(end);
  options.sources.push_back({test::on(BodyId{0}, std::nullopt), test::formula("47718*(1 + sin(0.0338*t))"), "source", {}});
  const HeatModel model = make_heat_model(mesh, Table<MaterialId, Material>({rock}), contact::ContactSet<2>(), options);
  TimeOptions time;
  time.until = 1400;
  time.output_every = 70;
  time.tolerance = 0.02;
  time.integrator = Integrator::stabilised_explicit;
  HeatRun run(model, time);
  run.advance_to(time.until);
  EXPECT_TRUE(run.within_tolerance());
  EXPECT_LT(run.state().rejected_steps, run.state().steps / 10);
}

// A surface that radiates to a flame does not come to its temperature.
TEST(ErrorGrowth, AsksNothingOfAFormulaWhereItHasNoValue) {
  const HeatModel model = bar_of(test::curve("sqrt(400 - T)"));
  ErrorGrowth growth(model);
  growth.include(between(300, 500));
  EXPECT_GT(largest_in(growth, model), 2e-3);
}

}  // namespace
}  // namespace scree::thermal
