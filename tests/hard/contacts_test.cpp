// Faces that lie on, nearly in, beside or deep in each other: what is found must not hang on rounding.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

double area_from(const ContactSet<3>& set, std::size_t owner) {
  double sum = 0;
  for (const auto& contact : set.contacts) {
    if (contact.owner == BlockId{owner}) sum += contact.area;
  }
  return sum;
}

mesh::BlockMesh<3> cube_beside(const Point<3>& shift) {
  return mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(1, 0, 0) + shift, at(1, 1, 1))});
}

ContactOptions of(Model model) {
  ContactOptions options;
  options.model = model;
  return options;
}

// A gap of rounding, one bit to either side, must neither lose nor double a contact.
TEST(TouchingFaces, ThatCoincideUpToRoundingCarryTheWholeFaceOnce) {
  for (const double gap : {0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-6, -1e-6}) {
    const auto springs = find_contacts<3>(cube_beside(at(gap, 0, 0)), of(Model::semi_spring));
    EXPECT_NEAR(area_from(springs, 0), 1, 1e-12) << gap;
    EXPECT_NEAR(area_from(springs, 1), 1, 1e-12) << gap;
    const auto overlaps = find_contacts<3>(cube_beside(at(gap, 0, 0)), of(Model::overlap));
    EXPECT_NEAR(area_from(overlaps, 0) + area_from(overlaps, 1), 1, 1e-9) << gap;
  }
}

// The second cube is turned about the common edge by an angle that keeps its far edge within the tolerance.
TEST(TouchingFaces, ThatAreNearlyCoplanarCarryTheWholeFace) {
  for (const double angle : {1e-9, 1e-6, 1e-4, 5e-3}) {
    auto mesh = cube_beside(at(0, 0, 0));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (const NodeId node : mesh.blocks[BlockId{1}].nodes) {
      mesh.nodes[node] = at(1, 0, 0) + turn * (mesh.nodes[node] - at(1, 0, 0));
    }
    const auto set = find_contacts<3>(mesh, of(Model::overlap));
    EXPECT_NEAR(area_from(set, 0) + area_from(set, 1), 1, 0.01) << angle;
  }
}

TEST(TouchingFaces, ThatMeetInAnEdgeOrAPointShareNoArea) {
  for (const Point<3>& shift : {at(0, 1, 0), at(0, 1, 1), at(0, 1 + 1e-15, 0), at(0, 1 - 1e-15, 1 + 1e-15)}) {
    const auto overlaps = find_contacts<3>(cube_beside(shift), of(Model::overlap));
    EXPECT_NEAR(area_from(overlaps, 0) + area_from(overlaps, 1), 0, 1e-9) << shift.transpose();
  }
}

// What is not in contact by the rule of the tolerance is not, however deep: neither half a cube nor one inside the other.
TEST(DeepOverlap, BeyondTheToleranceIsNoContactOfFaces) {
  for (const double depth : {0.5, 0.3}) {
    const auto set = find_contacts<3>(cube_beside(at(-depth, 0.05, 0.07)), of(Model::overlap));
    EXPECT_NEAR(area_from(set, 0) + area_from(set, 1), 0, 1e-12) << depth;
  }
  const auto inside = mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(0.4, 0.3, 0.35), at(0.2, 0.2, 0.2))});
  EXPECT_TRUE(find_contacts<3>(inside, of(Model::semi_spring)).contacts.empty());
}

// Two blocks in the same place: all faces coincide and look the same way, so none looks at another.
TEST(DeepOverlap, OfABlockWithItsCopyIsNoJoint) {
  const auto mesh = mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(0, 0, 0), at(1, 1, 1))});
  const auto set = find_contacts<3>(mesh, of(Model::overlap));
  EXPECT_NEAR(area_from(set, 0) + area_from(set, 1), 0, 1e-12);
}

}  // namespace
}  // namespace scree::contact
