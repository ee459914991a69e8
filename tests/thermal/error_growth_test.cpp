// What errors may become where a specific heat falls, against the ratio of capacities.
#include "thermal/error_growth.h"

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"

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

// A surface that radiates to a flame does not come to its temperature.
TEST(ErrorGrowth, AsksNothingOfAFormulaWhereItHasNoValue) {
  const HeatModel model = bar_of(test::curve("sqrt(400 - T)"));
  ErrorGrowth growth(model);
  growth.include(between(300, 500));
  EXPECT_GT(largest_in(growth, model), 2e-3);
}

}  // namespace
}  // namespace scree::thermal
