#include "engine/rigid/contact_points.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;
using packing::PlacedPiece;
using packing::Separation;

constexpr double clearance = 0.02;
constexpr double face_bias = 0.01;  // as large beside the clearance as that of a fall

mesh::ConvexPiece random_tetrahedron(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::array<Vector3d, 4> corners;
  do {
    for (Vector3d& corner : corners) corner = Vector3d(coordinate(random), coordinate(random), coordinate(random));
  } while ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) < 0.5);
  mesh::BlockMesh<3> mesh;
  return mesh::convex_pieces(mesh, testing::add_tetrahedron(mesh, corners)).front();
}

struct Missed {
  int pairs = 0;   // that are closer than the clearance
  int none = 0;    // of them without a contact
  int beside = 0;  // of them with none as close as the pieces are
};

// Random pairs, brought to a distance within the clearance along the axis that parts them.
Missed missed(double known_clearance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  Missed found;
  for (int i = 0; i < 4000; ++i) {
    const mesh::ConvexPiece first = random_tetrahedron(random), second = random_tetrahedron(random);
    const PlacedPiece a = packing::placed(first, Pose{});
    const Separation far = packing::separation(a, packing::placed(second, Pose{}), 1e300, face_bias);
    const Pose near{(part(random) * clearance - far.distance) * far.normal, Eigen::Quaterniond::Identity()};
    const PlacedPiece b = packing::placed(second, near);
    const Separation at = packing::separation(a, b, 1e300, face_bias);
    if (at.distance <= 0 || at.distance >= clearance) continue;
    ++found.pairs;
    const ContactPoints points = contact_points(a, b, at, {1.1 * clearance, known_clearance, 0});
    found.none += points.count == 0;
    const auto* end = points.points.begin() + points.count;
    found.beside += std::none_of(points.points.begin(), end, [](const ContactPoint& p) { return p.distance < clearance; });
  }
  return found;
}

TEST(ContactPoints, KeepEveryPairThatIsCloserThanTheClearance) {
  const Missed found = missed(clearance);
  EXPECT_GT(found.pairs, 2000);
  EXPECT_EQ(found.none, 0);
  EXPECT_EQ(found.beside, 0);
}

// Those that reach over the rim of a face: without a clearance they need none before they overlap.
TEST(ContactPoints, LeaveOutPairsThatReachOverTheRimOfAFaceAndDoNotOverlap) {
  EXPECT_GT(missed(0).none, 20);
}

}  // namespace
}  // namespace scree::rigid
