#include "engine/rigid/mass_properties.h"

#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d tensor(const MassProperties& p) {
  const Matrix3d axes = p.principal.toRotationMatrix();
  return axes * p.inertia.asDiagonal() * axes.transpose();
}

TEST(MassProperties, OfABoxAreTheClosedForm) {
  mesh::BlockMesh<3> mesh;
  const Pose pose{{1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()))};
  const BlockId box = testing::add_box(mesh, {0.2, 0.3, 0.5}, pose, false);
  const MassProperties p = mass_properties(mesh, box, 2000);
  const double mass = 2000 * 0.2 * 0.3 * 0.5;
  const Vector3d inertia = mass / 12 * Vector3d(0.3 * 0.3 + 0.5 * 0.5, 0.2 * 0.2 + 0.5 * 0.5, 0.2 * 0.2 + 0.3 * 0.3);
  const Matrix3d turn = pose.rotation.toRotationMatrix();
  EXPECT_NEAR(p.mass, mass, 1e-12 * mass);
  EXPECT_LT((p.centre - pose.translation).norm(), 1e-14);
  EXPECT_LT((tensor(p) - turn * inertia.asDiagonal() * turn.transpose()).norm(), 1e-13);
  EXPECT_GT(p.principal.toRotationMatrix().determinant(), 0);
}

// A cube corner of side 1: integrals of x^2 and x y over the simplex are 1/60 and 1/120.
TEST(MassProperties, OfATetrahedronAreTheClosedForm) {
  mesh::BlockMesh<3> mesh;
  const BlockId tet =
      testing::add_tetrahedron(mesh, {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)});
  const MassProperties p = mass_properties(mesh, tet, 6);
  const double square = 6.0 / 60 - 1.0 / 16;
  const double product = 6.0 / 120 - 1.0 / 16;
  Matrix3d expected = Matrix3d::Constant(-product);
  expected.diagonal().setConstant(2 * square);
  EXPECT_NEAR(p.mass, 1, 1e-15);
  EXPECT_LT((p.centre - Vector3d::Constant(0.25)).norm(), 1e-15);
  EXPECT_LT((tensor(p) - expected).norm(), 1e-15);
}

}  // namespace
}  // namespace scree::rigid
