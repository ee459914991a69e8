// Obtuse meshes are told from those that keep the maximum principle, and what they do is reported.
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/maximum_principle.h"

namespace scree::thermal {
namespace {

// Squares cut along a diagonal, sheared by `shear`: right angles at 0, obtuse ones beside.
HeatModel sheared_plate(double shear) {
  auto mesh = test::slab_mesh<2>({test::bar<2>(1, 8, 8, 1)});
  for (const NodeId node : mesh.nodes.ids()) mesh.nodes[node][0] += shear * mesh.nodes[node][1];
  HeatOptions options = test::options_for(mesh, 300);
  Boundary hot;
  hot.name = "hot";
  hot.region = test::on(BodyId{0}, Aabb<3>(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(3, 1e-9, 1)));
  hot.condition = FixedTemperature{400};
  options.boundaries.push_back(hot);
  return make_heat_model(mesh, test::rock_only(), contact::ContactSet<2>{}, options);
}

HeatState heated(const HeatModel& model) {
  TimeOptions options;
  options.until = 20;
  options.output_every = 20;
  HeatRun run(model, options);
  run.advance_to(20);
  return run.state();
}

TEST(MaximumPrinciple, HoldsOnRightTrianglesAndNothingOvershoots) {
  const HeatModel model = sheared_plate(0);
  EXPECT_EQ(maximum_principle(model).reversed, 0);
  EXPECT_LT(*overshoot(model, heated(model)), 1e-6);
}

TEST(MaximumPrinciple, IsBrokenByObtuseTrianglesWhichTheCountSaysAndTheOvershootShows) {
  const HeatModel model = sheared_plate(3);
  const MaximumPrinciple found = maximum_principle(model);
  EXPECT_GT(found.reversed, 0);
  EXPECT_LT(found.reversed, found.pairs);
  EXPECT_GT(found.largest, 0.1);
  EXPECT_GT(*overshoot(model, heated(model)), 0.1);
}

// Cotangent formula of a triangle, k t (-cot angle)/2: a single triangle with one angle of 120 degrees has one positive entry,
// half of tan 30 degrees.
TEST(MaximumPrinciple, CountsTheOneObtuseAngleOfATriangle) {
  mesh::BlockMesh<2> mesh;
  const BodyId body = mesh.bodies.push_back({"body", MaterialId{0}, false, {}});
  for (const Point<2>& corner : {Point<2>(0, 0), Point<2>(1, 0), Point<2>(-0.5, std::sqrt(3.0) / 2)})
    mesh.nodes.push_back(corner);
  mesh.elements.push_back({NodeId{0}, NodeId{1}, NodeId{2}});
  mesh.blocks.push_back({body, {0, 3}, {0, 1}});
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<2>{}, test::options_for(mesh, 300));
  const MaximumPrinciple found = maximum_principle(model);
  EXPECT_EQ(found.pairs, 3);
  EXPECT_EQ(found.reversed, 1);
}

}  // namespace
}  // namespace scree::thermal
