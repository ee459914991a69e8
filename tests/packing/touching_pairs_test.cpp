#include "engine/packing/touching_pairs.h"

#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::packing {
namespace {

using Eigen::Vector3d;
using rigid::testing::add_box;
using rigid::testing::add_tetrahedron;

const Vector3d cube(1, 1, 1);

std::vector<TouchingPair> pairs_of(const mesh::BlockMesh<3>& mesh) {
  const PieceSet pieces(mesh);
  return touching_pairs(pieces, {1e-3, 0.03});
}

// The only pair of two cubes, the second at a pose.
TouchingPair only_pair(const Pose& pose) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, cube, Vector3d(0, 0, 0), true);
  add_box(mesh, cube, pose, false);
  const auto pairs = pairs_of(mesh);
  EXPECT_EQ(pairs.size(), 1U);
  return pairs.empty() ? TouchingPair{} : pairs.front();
}

Eigen::Quaterniond turned(double angle, const Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

TEST(TouchingPairs, ACubeOnACubeMeetsFaceToFaceWithItsGap) {
  const TouchingPair lying = only_pair({Vector3d(0.3, -0.2, 1.0004), turned(0.4, Vector3d::UnitZ())});
  EXPECT_EQ(lying.meeting, Meeting::face_face);
  EXPECT_NEAR(lying.gap, 0.0004, 1e-12);
  const TouchingPair pressed = only_pair({Vector3d(0.3, -0.2, 0.98), Eigen::Quaterniond::Identity()});
  EXPECT_EQ(pressed.meeting, Meeting::face_face);
  EXPECT_NEAR(pressed.gap, -0.02, 1e-12);
}

TEST(TouchingPairs, FacesThatLeanMoreThanAllowedMeetAlongAnEdge) {
  for (const auto& [angle, meeting] : {std::pair(0.02, Meeting::face_face), {0.04, Meeting::face_edge}}) {
    // The lower edge of the leaning cube stays in the plane.
    const double rise = 0.5 * (std::cos(angle) + std::sin(angle));
    EXPECT_EQ(only_pair({Vector3d(0, 0.2, 0.5 + rise), turned(angle, Vector3d::UnitX())}).meeting, meeting);
  }
}

TEST(TouchingPairs, ACubeOnItsEdgeMeetsAFaceInAnEdgeAndOnItsCornerInAPoint) {
  EXPECT_EQ(only_pair({Vector3d(0, 0, 0.5 + std::sqrt(0.5)), turned(M_PI / 4, Vector3d::UnitX())}).meeting, Meeting::face_edge);
  const auto on_corner = Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d::UnitZ());
  const TouchingPair standing = only_pair({Vector3d(0.1, 0, 0.5 + std::sqrt(0.75)), on_corner});
  EXPECT_EQ(standing.meeting, Meeting::face_point);
  EXPECT_NEAR(standing.gap, 0, 1e-12);
}

TEST(TouchingPairs, CrossedEdgesMeetEdgeToEdgeAndSoDoFacesThatShareARimOnly) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 1, 1}, Pose{Vector3d::Zero(), turned(M_PI / 4, Vector3d::UnitX())}, true);
  add_box(mesh, {1, 4, 1}, Pose{Vector3d(0, 0, 2 * std::sqrt(0.5)), turned(M_PI / 4, Vector3d::UnitY())}, false);
  EXPECT_EQ(pairs_of(mesh).front().meeting, Meeting::edge_edge);
  EXPECT_EQ(only_pair({Vector3d(0.9995, 0, 1), Eigen::Quaterniond::Identity()}).meeting, Meeting::edge_edge);
}

// Of twelve tetrahedra: a floor of 4 x 4 x 4 whose top lies at 0.5, turned, and a wall at one end of it.
void add_l(mesh::BlockMesh<3>& mesh, const Eigen::Quaterniond& floor) {
  add_box(mesh, {4, 4, 4}, Pose{Vector3d(0, 0, -1.5), floor}, true);
  add_box(mesh, {1, 4, 6}, Vector3d(2.5, 0, 0), true);
  const BodyId body = mesh.blocks[BlockId{0}].body;
  mesh.blocks = {};
  mesh.blocks.push_back({body, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
}

TEST(TouchingPairs, OnABlockOfSeveralPiecesFacesEdgesAndCornersAreToldApartWhereverItsSeamsAre) {
  const auto on_corner = Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d::UnitZ());
  for (const int quarters : {0, 1, 2, 3}) {
    for (const auto& [x, y] : {std::pair(-1.3, -1.2), {-0.6, 0.0}, {0.0, 0.0}, {0.0, 0.37}, {0.45, -1.2}}) {
      const auto floor = turned(quarters * M_PI / 2, Vector3d::UnitY()) * turned(quarters * M_PI / 2, Vector3d::UnitZ());
      const Vector3d at(x, y, 0.5);
      const auto meeting_at = [&](double height, const Eigen::Quaterniond& rotation) {
        mesh::BlockMesh<3> mesh;
        add_l(mesh, floor);
        add_box(mesh, cube, Pose{at + height * Vector3d::UnitZ(), rotation}, false);
        const auto pairs = pairs_of(mesh);
        EXPECT_EQ(pairs.size(), 1U);
        return pairs.empty() ? Meeting::point_point : pairs.front().meeting;
      };
      EXPECT_EQ(meeting_at(0.5, Eigen::Quaterniond::Identity()), Meeting::face_face) << x << " " << y;
      const auto on_edge = turned(0.3, Vector3d::UnitZ()) * turned(M_PI / 4, Vector3d::UnitX());
      EXPECT_EQ(meeting_at(std::sqrt(0.5), on_edge), Meeting::face_edge) << x << " " << y;
      EXPECT_EQ(meeting_at(std::sqrt(0.75), on_corner), Meeting::face_point) << x << " " << y;
    }
  }
}

// Its lowest corner lies over another piece than the rest of the cube, which only that corner's tip is over.
TEST(TouchingPairs, ACubeThatHardlyLeansMeetsTheFaceItLiesOnThoughAnotherPieceIsNearer) {
  for (const int quarters : {0, 1, 2, 3}) {
    for (const double side : {-1.0, 1.0}) {
      mesh::BlockMesh<3> mesh;
      add_l(mesh, turned(quarters * M_PI / 2, Vector3d::UnitZ()));
      const Vector3d lower = Vector3d(-side, -1, 0).normalized();
      const Eigen::Quaterniond lean = turned(1e-4, Vector3d::UnitZ().cross(lower));
      add_box(mesh, cube, Pose{Vector3d(0.5 * side, 0.4997, 1.0001), lean}, false);
      const auto pairs = pairs_of(mesh);
      ASSERT_EQ(pairs.size(), 1U);
      EXPECT_EQ(pairs.front().meeting, Meeting::face_face) << quarters << " " << side;
      EXPECT_NEAR(pairs.front().gap, 0.0001 - 1e-4 * std::sqrt(0.5), 1e-7);
    }
  }
}

TEST(TouchingPairs, ACubicLatticeHasSixNeighboursInsideAndOnlyFacesThatMeet) {
  mesh::BlockMesh<3> mesh;
  constexpr int n = 4;
  for (int i = 0; i < n * n * n; ++i) {
    add_box(mesh, cube, Vector3d(1.0005 * (i % n), 1.0005 * (i / n % n), 1.0005 * (i / n / n)), false);
  }
  std::size_t faces = 0;
  for (const TouchingPair& pair : pairs_of(mesh)) {
    // Diagonal neighbours are as near along both axes, but meet at their rims.
    if (pair.meeting == Meeting::face_face) ++faces;
    EXPECT_NEAR(pair.gap, 0.0005, 1e-9);
  }
  EXPECT_EQ(faces, 3U * n * n * (n - 1));
}

TEST(TouchingPairs, ABlockOfSeveralPiecesCountsOnceWithItsDeepestPiece) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, cube, Vector3d(0, 0, 0), true);
  mesh.nodes[NodeId{7}] = Vector3d(0.2, 0.2, 0.2);  // a corner pushed in: six tetrahedra
  add_box(mesh, {0.2, 0.2, 0.2}, Vector3d(-0.595, 0.01, -0.03), false);
  const auto pairs = pairs_of(mesh);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs.front().gap, -0.005, 1e-12);
}

TEST(TouchingPairs, FixedBlocksAreNoPairAndDistantOnesNeither) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, cube, Vector3d(0, 0, 0), true);
  add_box(mesh, cube, Vector3d(1, 0, 0), true);
  add_tetrahedron(mesh, {Vector3d(0, 0, 0.502), Vector3d(1, 0, 1), Vector3d(0, 1, 1), Vector3d(0, 0, 1)});
  EXPECT_TRUE(pairs_of(mesh).empty());
}

}  // namespace
}  // namespace scree::packing
