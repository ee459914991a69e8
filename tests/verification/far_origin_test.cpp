// A scene in metres of a national grid is what it is at the origin, where coordinates are off by a nanometre.
#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "thermal/effective_conductivity.h"

namespace scree::thermal {
namespace {

template <int dim>
using Contacts = contact::ContactSet<dim>;

// Two cubes of 0.2 m side by side, whose meshes do not match: nothing has the same corners.
template <int dim>
Contacts<dim> contacts_at(const Point<dim>& site) {
  std::vector<test::Slab<dim>> cubes{test::bar<dim>(0.2, 4, 4, 0.2), test::bar<dim>(0.2, 3, 3, 0.2)};
  for (auto& cube : cubes) cube.low = site;
  cubes[1].low[0] += 0.2;
  return contact::find_contacts(test::slab_mesh<dim>(cubes), {});
}

template <int dim>
void expect_the_same_contacts() {
  const std::size_t count = contacts_at<dim>(Point<dim>::Zero()).contacts.size();
  EXPECT_GT(count, 10);
  for (const Eigen::Vector3d& site :
       {Eigen::Vector3d(412345.6, 5412345.7, 123.4), {589204.8, 9869435.4, 0}, {1e7 / 3, 7e6 / 3, 1}}) {
    EXPECT_EQ(contacts_at<dim>(site.head<dim>()).contacts.size(), count) << site.transpose();
  }
}

TEST(FarOrigin, SemiSpringsOfClosedJointsAreAllFound) {
  expect_the_same_contacts<2>();
  expect_the_same_contacts<3>();
}

// The region's numbers are those of the scene, the mesh's are sums.
TEST(FarOrigin, AThinRegionAboutASideHoldsAllOfIt) {
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d centre(589204.95 + 0.37 * i, 9869435.55 - 1.13 * i, 0.15);
    test::Slab<3> cube = test::bar<3>(0.3, 3, 3, 0.3);
    cube.low = centre - Eigen::Vector3d::Constant(0.15);
    const auto mesh = test::slab_mesh<3>({cube});
    HeatOptions options = test::options_for(mesh, 300);
    const auto written = [](double value) { return std::round(value * 100) / 100; };
    const Eigen::Vector3d low(written(cube.low.x()), written(cube.low.y()), 0.3);
    const Eigen::Vector3d high(written(cube.low.x() + 0.3), written(cube.low.y() + 0.3), 0.3);
    options.boundaries.push_back({test::on(BodyId{0}, Aabb<3>{low, high}), HeatFlux{100}, "top", {}});
    const HeatModel model = make_heat_model(mesh, test::rock_only(), Contacts<3>{}, options);
    double area = 0;
    for (const double share : model.loads.at(0).on.shares) area += share;
    EXPECT_NEAR(area, 0.09, 1e-6) << i;
  }
}

TEST(FarOrigin, ABlockThatFillsTheWindowIsItself) {
  test::Slab<3> cube = test::bar<3>(0.3, 3, 3, 0.3);
  cube.low = Eigen::Vector3d(589204.8, 9869435.4, 0);
  const auto mesh = test::slab_mesh<3>({cube});
  const HeatModel model = make_heat_model(mesh, test::rock_only(), Contacts<3>{}, test::options_for(mesh, 300));
  const Aabb<3> window{Eigen::Vector3d(589204.8, 9869435.4, 0), Eigen::Vector3d(589205.1, 9869435.7, 0.3)};
  const auto found = effective_conductivity<3>(mesh, test::rock_only(), model, window);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found.along[axis], 4, 1e-6);
  ASSERT_TRUE(found.lower);
  EXPECT_LT((*found.lower - 4 * Eigen::Matrix3d::Identity()).norm(), 1e-6);
}

}  // namespace
}  // namespace scree::thermal
