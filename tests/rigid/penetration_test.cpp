#include "engine/packing/penetration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "engine/packing/separation.h"
#include "tests/rigid/blocks.h"

namespace scree::packing {
namespace {

using Eigen::Vector3d;
using rigid::testing::add_box;
using rigid::testing::add_tetrahedron;

double largest(const PlacedPiece& a, const Vector3d& axis, double sign) {
  double best = -1e300;
  for (const Vector3d& v : a.vertices) best = std::max(best, sign * axis.dot(v));
  return best;
}

// All axes, projecting every vertex: face normals and every cross product of two edges.
double brute_force(const PlacedPiece& a, const PlacedPiece& b) {
  std::vector<Vector3d> axes = a.normals;
  axes.insert(axes.end(), b.normals.begin(), b.normals.end());
  for (const auto& e : a.piece->edges) {
    for (const auto& f : b.piece->edges) {
      const Vector3d axis =
          (a.vertices[e.corners[1]] - a.vertices[e.corners[0]]).cross(b.vertices[f.corners[1]] - b.vertices[f.corners[0]]);
      if (axis.norm() > 1e-12) axes.push_back(axis.normalized());
    }
  }
  double best = -1e300;
  for (const Vector3d& axis : axes) {
    best = std::max(best, -largest(b, axis, -1) - largest(a, axis, 1));
    best = std::max(best, -largest(a, axis, -1) - largest(b, axis, 1));
  }
  return best;
}

mesh::ConvexPiece random_tetrahedron(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  mesh::BlockMesh<3> mesh;
  std::array<Vector3d, 4> corners;
  do {
    for (Vector3d& corner : corners) corner = Vector3d(coordinate(random), coordinate(random), coordinate(random));
  } while ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) < 0.1);
  return mesh::convex_pieces(mesh, add_tetrahedron(mesh, corners)).front();
}

// Turned at random, up to 1 m away along each axis.
Pose random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const Eigen::Quaterniond turn(coordinate(random), coordinate(random), coordinate(random), coordinate(random));
  return {Vector3d(coordinate(random), coordinate(random), coordinate(random)), turn.normalized()};
}

// That of the best of all axes where the pieces overlap, else no more than that. Returns whether they do.
bool expect_best_axis(const PlacedPiece& a, const PlacedPiece& b, const Separation& found) {
  const double expected = brute_force(a, b);
  if (expected < 0) {
    EXPECT_NEAR(found.distance, expected, 1e-9);
  } else {
    EXPECT_GT(found.distance, 0);
    EXPECT_LE(found.distance, expected + 1e-9);
  }
  return expected < 0;
}

// A prism over a regular polygon, cut into three tetrahedra for each of its sides.
mesh::ConvexPiece prism(int sides, double height) {
  mesh::BlockMesh<3> mesh;
  const BodyId body = mesh.bodies.push_back({"prism", MaterialId{0}, false, Vector3d::Zero()});
  for (const double z : {0.0, height}) {
    mesh.nodes.push_back(Vector3d(0, 0, z));
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      mesh.nodes.push_back(Vector3d(std::cos(angle), std::sin(angle), z));
    }
  }
  const auto node = [&](int level, int i) { return NodeId{static_cast<std::size_t>(level * (sides + 1) + 1 + i % sides)}; };
  const NodeId low{0}, high{static_cast<std::size_t>(sides + 1)};
  for (int i = 0; i < sides; ++i) {
    mesh.elements.push_back({low, node(0, i), node(0, i + 1), node(1, i + 1)});
    mesh.elements.push_back({low, node(0, i), node(1, i + 1), node(1, i)});
    mesh.elements.push_back({low, node(1, i), node(1, i + 1), high});
  }
  const BlockId block = mesh.blocks.push_back({body, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
  return mesh::convex_pieces(mesh, block).front();
}

TEST(Separation, OfPiecesOfAnyNumberOfFacesIsThatOfEveryAxisTried) {
  std::mt19937 random(23);
  int overlapping = 0;
  for (int sides = 3; sides <= 11; ++sides) {
    const mesh::ConvexPiece first = prism(sides, 1), second = prism(14 - sides, 0.6);
    ASSERT_EQ(first.faces.size(), static_cast<std::size_t>(sides) + 2);
    for (int i = 0; i < 40; ++i) {
      SCOPED_TRACE(sides);
      Pose pose = random_pose(random);
      pose.translation *= 1.5;
      const PlacedPiece a = placed(first, Pose{}), b = placed(second, pose);
      const Separation found = separation(a, b, 1e300);
      overlapping += expect_best_axis(a, b, found);
      EXPECT_NEAR(separation_along(a, b, found), found.distance, 1e-15);
    }
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 310);
}

// Neighbours in a mesh: many axes part them equally well, to rounding.
TEST(Separation, OfPiecesThatShareCornersIsNothing) {
  std::mt19937 random(29);
  for (int i = 0; i < 300; ++i) {
    const mesh::ConvexPiece first = random_tetrahedron(random);
    const int shared = 1 + i % 3;
    Vector3d middle = Vector3d::Zero();
    for (int k = 0; k < shared; ++k) middle += first.vertices[k] / shared;
    std::array<Vector3d, 4> corners;  // those that are not shared lie across what is
    for (int k = 0; k < 4; ++k) corners[k] = k < shared ? first.vertices[k] : Vector3d(2 * middle - first.vertices[k]);
    const double volume = (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]);
    if (volume < 0) std::swap(corners[0], corners[1]);
    mesh::BlockMesh<3> mesh;
    const mesh::ConvexPiece second = mesh::convex_pieces(mesh, add_tetrahedron(mesh, corners)).front();
    EXPECT_NEAR(separation(placed(first, Pose{}), placed(second, Pose{}), 1e300).distance, 0, 1e-14) << i;
  }
}

TEST(Separation, OfRandomPiecesIsThatOfEveryAxisTried) {
  std::mt19937 random(7);
  mesh::BlockMesh<3> boxes;
  const mesh::ConvexPiece box = mesh::convex_pieces(boxes, add_box(boxes, {1, 0.7, 0.4}, Vector3d(0, 0, 0), false)).front();
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    const mesh::ConvexPiece first = i % 2 == 0 ? box : random_tetrahedron(random);
    const mesh::ConvexPiece second = random_tetrahedron(random);
    SCOPED_TRACE(i);
    const PlacedPiece a = placed(first, Pose{});
    const PlacedPiece b = placed(second, random_pose(random));
    overlapping += expect_best_axis(a, b, separation(a, b, 1e300));
  }
  EXPECT_GT(overlapping, 400);
  EXPECT_LT(overlapping, 1900);
}

TEST(Separation, MovingApartByItEndsTheOverlap) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const mesh::ConvexPiece first = random_tetrahedron(random);
    const mesh::ConvexPiece second = random_tetrahedron(random);
    const PlacedPiece a = placed(first, Pose{});
    const Separation s = separation(a, placed(second, Pose{}), 1e300);
    if (s.distance >= 0) continue;
    const Pose away{-s.distance * s.normal, Eigen::Quaterniond::Identity()};
    EXPECT_NEAR(separation(a, placed(second, away), 1e300).distance, 0, 1e-9);
    EXPECT_NEAR(separation_along(a, placed(second, away), s), 0, 1e-9);
  }
}

TEST(ConvexPieces, ABoxOfTetrahedraIsOnePieceOfSixFaces) {
  mesh::BlockMesh<3> mesh;
  const auto pieces = mesh::convex_pieces(mesh, add_box(mesh, {1, 2, 3}, Vector3d(5, 5, 5), false));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].vertices.size(), 8U);
  EXPECT_EQ(pieces[0].faces.size(), 6U);
  EXPECT_EQ(pieces[0].edges.size(), 12U);
  for (const auto& face : pieces[0].faces) {
    ASSERT_EQ(face.corners.size(), 4U);
    for (const auto& vertex : pieces[0].vertices)
      EXPECT_LE(face.normal.dot(vertex - pieces[0].vertices[face.corners[0]]), 1e-12);
  }
}

TEST(ConvexPieces, ABlockWithAnIndentedEdgeIsItsElements) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {1, 1, 1}, Vector3d(0, 0, 0), false);
  mesh.nodes[NodeId{7}] = Vector3d(0.2, 0.2, 0.2);  // one corner pushed in
  EXPECT_EQ(mesh::convex_pieces(mesh, BlockId{0}).size(), 6U);
}

const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));

// A box of n x n squares a side, its corners rounded to multiples of `digit`, turned; a fan of tetrahedra about its middle.
mesh::BlockMesh<3> rounded_box(int n, double digit) {
  mesh::BlockMesh<3> mesh;
  const BodyId body = mesh.bodies.push_back({"box", MaterialId{0}, false, Vector3d::Zero()});
  std::map<std::array<int, 3>, NodeId> nodes;
  const NodeId middle = mesh.nodes.push_back(Vector3d::Zero());
  const auto node = [&](std::array<int, 3> at) {
    const auto [found, fresh] = nodes.emplace(at, NodeId{mesh.nodes.size()});
    if (fresh) {
      const Vector3d exact = turn * (0.1 * (Vector3d(at[0], at[1], at[2]) / n - Vector3d::Constant(0.5)));
      mesh.nodes.push_back(digit > 0 ? Vector3d((exact / digit).array().round() * digit) : exact);
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int height : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> at{};
            at[axis] = height;
            at[(axis + 1) % 3] = i + a;
            at[(axis + 2) % 3] = j + b;
            return node(at);
          };
          std::array<std::array<NodeId, 3>, 2> halves{
              {{corner(0, 0), corner(1, 0), corner(1, 1)}, {corner(0, 0), corner(1, 1), corner(0, 1)}}};
          for (auto& half : halves) {
            if (height == 0) std::swap(half[1], half[2]);
            mesh.elements.push_back({middle, half[0], half[1], half[2]});
          }
        }
      }
    }
  }
  mesh.blocks.push_back({body, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
  return mesh;
}

TEST(ConvexPieces, ABoxWhoseCornersAreRoundedIsOnePieceOfSixFaces) {
  for (const double digit : {0.0, 6e-9, 1e-7}) {
    for (const int n : {1, 3, 14, 20}) {
      const auto pieces = mesh::convex_pieces(rounded_box(n, digit), BlockId{0});
      ASSERT_EQ(pieces.size(), 1) << n << " " << digit;
      EXPECT_EQ(pieces[0].faces.size(), 6) << n << " " << digit;
      EXPECT_EQ(pieces[0].vertices.size(), 8) << n << " " << digit;
      EXPECT_EQ(pieces[0].edges.size(), 12) << n << " " << digit;
    }
  }
}

// Rounded more: faces are bent along their diagonals, inwards or outwards, and the box lies on them all the same.
TEST(Penetration, ABoxWithDentedFacesLiesOnAPlateAsDeepAsTheyAre) {
  for (const double digit : {1e-7, 1e-6, 1e-5}) {
    for (const int n : {1, 2}) {
      mesh::BlockMesh<3> mesh = rounded_box(n, digit);
      for (Vector3d& node : mesh.nodes) node = turn.conjugate() * node + Vector3d(0, 0, 0.052);
      add_box(mesh, {1, 1, 0.1}, Vector3d(0, 0, -0.05), true);
      const auto packing = rigid::settle(mesh, rigid::testing::material(0.5), rigid::testing::for_time(0.5));
      EXPECT_NEAR(packing.settled->top, 0.1, 3 * digit + 1e-6) << digit << " " << n;
      EXPECT_LT(packing.settled->max_penetration, 3 * digit + 1e-6) << digit << " " << n;
    }
  }
}

TEST(ConvexPieces, TwoLooseBoxesInOneBlockAreNotConvex) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {1, 1, 1}, Vector3d(0, 0, 0), false);
  add_box(mesh, {1, 1, 1}, Vector3d(3, 0, 0), false);
  mesh.blocks = Table<BlockId, mesh::Block>();
  const BlockId both = mesh.blocks.push_back({BodyId{0}, {0, 16}, {0, 12}});
  EXPECT_EQ(mesh::convex_pieces(mesh, both).size(), 12U);
}

TEST(Penetration, OfBoxesIsTheOverlapOfTheirSides) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {1, 1, 1}, Vector3d(0, 0, 0), true);
  add_box(mesh, {1, 1, 1}, Vector3d(0.99, 0.2, 0.1), false);   // 0.01 into the first
  add_box(mesh, {1, 1, 1}, Vector3d(-0.2, 0, 1.0005), false);  // touches the first within the range
  add_box(mesh, {1, 1, 1}, Vector3d(0, -1.5, 0), false);       // alone
  add_box(mesh, {1, 1, 1}, Vector3d(-0.5, 0, 0), true);        // fixed in the fixed one: nobody's business
  const Penetration p = measure_penetration(PieceSet(mesh), 1e-3);
  EXPECT_NEAR(p.max, 0.01, 1e-12);
  EXPECT_EQ(p.first, BlockId{0});
  EXPECT_EQ(p.second, BlockId{1});
  EXPECT_EQ(p.touching, 3U);  // 0-1, 0-2, 4-2
  EXPECT_NEAR(p.mean, 0.01 / 3, 1e-12);
}

TEST(Penetration, OfCrossedEdgesIsTheirDepth) {
  // Two bars turned by 45 degrees about their axes, crossing at right angles, edge on edge.
  mesh::BlockMesh<3> mesh;
  const Eigen::AngleAxisd edge_up_x(M_PI / 4, Vector3d::UnitX());
  const Eigen::AngleAxisd edge_up_y(M_PI / 4, Vector3d::UnitY());
  const double half_diagonal = std::sqrt(0.5);
  add_box(mesh, {9, 1, 1}, Pose{Vector3d::Zero(), Eigen::Quaterniond(edge_up_x)}, true);
  add_box(mesh, {1, 9, 1}, Pose{Vector3d(0, 0, 2 * half_diagonal - 0.03), Eigen::Quaterniond(edge_up_y)}, false);
  EXPECT_NEAR(measure_penetration(PieceSet(mesh), 1e-3).max, 0.03, 1e-12);
}

TEST(Penetration, OfTheElementsOfAMeshIsNothing) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {1, 1, 1}, Vector3d(0, 0, 0), false);
  mesh::BlockMesh<3> broken;
  for (const auto& element : mesh.elements) {
    add_tetrahedron(broken, {mesh.nodes[element[0]], mesh.nodes[element[1]], mesh.nodes[element[2]], mesh.nodes[element[3]]});
  }
  const Penetration p = measure_penetration(PieceSet(broken), 1e-3);
  EXPECT_EQ(p.touching, 15U);  // all share the diagonal
  EXPECT_LT(p.max, 1e-12);
}

}  // namespace
}  // namespace scree::packing
