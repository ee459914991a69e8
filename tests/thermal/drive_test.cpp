#include "thermal/drive.h"

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"

namespace scree::thermal {
namespace {

TEST(Drives, KeepTheStartOfAStepThatIsTriedAgainWithOtherStages) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(1, 2, 1, 1)});
  ValueRule rule;
  rule.quantity = quantity::temperature;
  const auto kelvin = std::get<UnitConverter>(unit_converter("K", quantity::temperature));
  HeatOptions options = test::options_for(mesh, 300);
  Boundary left;
  left.name = "left";
  left.region = test::on(BodyId{0}, test::between_x(0, 0));
  left.condition = FixedTemperature{Function::from_expression("300 + t", kelvin, rule)};
  options.boundaries.push_back(left);
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<2>{}, options);
  Drives drives(model);
  for (const double time : {1.0, 2.0, 3.0}) drives.at(time);  // of the step before
  const Drive& start = drives.at(3);
  for (const double stage : {7.0, 11.0}) drives.at(stage);
  EXPECT_EQ(&drives.at(3), &start);
  for (const double stage : {5.0, 6.0}) drives.at(stage);
  EXPECT_EQ(&drives.at(3), &start);
  EXPECT_EQ(start.fixed[0], 303);
}

}  // namespace
}  // namespace scree::thermal
