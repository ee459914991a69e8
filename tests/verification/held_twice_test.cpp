// Temperatures that are held twice must agree at all times of a run, not as it begins only.
#include <gmock/gmock.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_model.h"

namespace scree::thermal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Boundary held_at(BodyId body, double x, const Function& temperature, const std::string& name) {
  Boundary boundary = test::hold(body, x, 0, name);
  boundary.condition = FixedTemperature{temperature};
  return boundary;
}

std::string refusal(const mesh::BlockMesh<2>& mesh, const std::vector<Boundary>& boundaries) {
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = PerfectJoint{};
  options.boundaries = boundaries;
  options.time.until = 20000;
  try {
    make_heat_model(mesh, Table<MaterialId, Material>({test::rock()}), test::matching_contacts(mesh), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

mesh::BlockMesh<2> two_bars() {
  std::vector<test::Slab<2>> bars(2, test::bar<2>(1, 4, 2, 0.5));
  bars[1].low[0] = 1;
  return test::slab_mesh<2>(bars);
}

TEST(HeldTwice, APerfectJointIsRefusedThatComesApartLater) {
  const auto at_joint = [](const std::string& right) {
    return refusal(two_bars(), {held_at(BodyId{0}, 1, 300.0, "left"), held_at(BodyId{1}, 1, test::formula(right), "right")});
  };
  EXPECT_THAT(at_joint("300"), IsEmpty());
  EXPECT_THAT(at_joint("300+0*t"), IsEmpty());
  EXPECT_THAT(at_joint("310"), HasSubstr("by left and by right, 10 K apart (must have one temperature)"));
  EXPECT_THAT(at_joint("300+t/400"), HasSubstr("K apart at "));
  EXPECT_THAT(at_joint("300+50*((t>9000)&&(t<9100))"), HasSubstr("50 K apart at "));
}

TEST(HeldTwice, ANodeIsRefusedThatIsHeldAtTwoTemperaturesInAPulse) {
  const auto at_end = [](const std::string& second) {
    return refusal(test::slab_mesh<2>({test::bar<2>(2, 4, 3, 0.5)}),
                   {held_at(BodyId{0}, 0, 300.0, "first"), held_at(BodyId{0}, 0, test::formula(second), "second")});
  };
  EXPECT_THAT(at_end("300+50*((t>9000)&&(t<9100))"), HasSubstr("second is 350 K at 90"));
}

TEST(HeldTwice, RoundingIsNoDifference) {
  const std::string message = refusal(
      test::slab_mesh<2>({test::bar<2>(2, 4, 3, 0.5)}),
      {held_at(BodyId{0}, 0, 300.95, "first"), held_at(BodyId{0}, 0, test::formula("273.15 + 27.8 + 1e-13*(1+x)"), "second")});
  EXPECT_THAT(message, IsEmpty());
}

}  // namespace
}  // namespace scree::thermal
