#include "engine/output/stored_field.h"

#include <cmath>
#include <map>

#include <gmock/gmock.h>

#include "engine/mesh/make_blocks.h"
#include "engine/output/series.h"
#include "tests/temp_folder.h"

namespace scree::output {

namespace {

using testing::HasSubstr;

// Two unit squares beside each other, each of 2 n^2 triangles; their common side belongs to both.
mesh::BlockMesh<2> two_squares(int n) {
  mesh::BlockMesh<2> mesh;
  for (int block = 0; block < 2; ++block) {
    const BodyId body = mesh.bodies.push_back({block == 0 ? "left" : "right", MaterialId{0}, false, {}});
    const std::size_t first = mesh.nodes.size();
    const std::size_t first_element = mesh.elements.size();
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) mesh.nodes.push_back(Point<2>(block + double(i) / n, double(j) / n));
    }
    const auto node = [&](int i, int j) { return NodeId{first + static_cast<std::size_t>(j * (n + 1) + i)}; };
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        mesh.elements.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
        mesh.elements.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    }
    mesh.blocks.push_back({body, {first, mesh.nodes.size()}, {first_element, mesh.elements.size()}});
  }
  return mesh;
}

// Linear in each square, with a jump of 100 K between them.
double exact(const mesh::BlockMesh<2>& mesh, NodeId node, double time) {
  const Point<2>& at = mesh.nodes[node];
  return 300 + 10 * at.x() - 7 * at.y() + (node.index() < mesh.blocks[BlockId{0}].nodes.size() ? 0 : 100) + time;
}

std::filesystem::path folder() {
  return test::temp_folder() / "stored";
}

// A series of these times, of temperatures by node and time.
template <int dim, class Value>
void store(const mesh::BlockMesh<dim>& mesh, const std::vector<double>& times, const Value& value) {
  std::filesystem::remove_all(folder());
  std::filesystem::create_directories(folder());
  Series series(folder(), "heat");
  for (const double time : times) {
    std::vector<double> values;
    for (const NodeId node : mesh.nodes.ids()) values.push_back(value(node, time));
    series.write(make_grid(mesh), {time, {{"temperature", 1, values}}, {}});
  }
}

// Of two times, 0 and 60 s.
void store(const mesh::BlockMesh<2>& mesh) {
  store(mesh, {0.0, 60.0}, [&](NodeId node, double time) { return exact(mesh, node, time); });
}

double largest_error(const NodalField& field, const mesh::BlockMesh<2>& mesh, double time) {
  double error = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    error = std::max(error, std::abs(field.values[static_cast<Eigen::Index>(node.index())] - exact(mesh, node, time)));
  }
  return error;
}

std::string wrong_with(const StoredField& stored, const mesh::BlockMesh<2>& mesh) {
  try {
    read_stored(stored, mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StoredField, OnTheSameMeshEveryNodeHasItsValueAgain) {
  const auto mesh = two_squares(3);
  store(mesh);
  const NodalField last = read_stored({folder(), {}}, mesh);
  EXPECT_TRUE(last.same_mesh);
  EXPECT_EQ(largest_error(last, mesh, 60), 0);
  EXPECT_EQ(largest_error(read_stored({folder(), 0.0}, mesh), mesh, 0), 0);
  EXPECT_EQ(largest_error(read_stored({folder() / "heat.pvd", 60.0}, mesh), mesh, 60), 0);
  EXPECT_EQ(largest_error(read_stored({folder() / "heat" / "heat_000000.vtu", {}}, mesh), mesh, 0), 0);
}

TEST(StoredField, OnAnotherMeshALinearFieldIsKeptOnBothSidesOfAJump) {
  store(two_squares(3));
  const auto mesh = two_squares(4);
  const NodalField field = read_stored({folder(), {}}, mesh);
  EXPECT_FALSE(field.same_mesh);
  EXPECT_EQ(field.moved, 0u);
  EXPECT_LT(largest_error(field, mesh, 60), 1e-4);
}

// Two unit cubes beside each other, each of 6 n^3 tetrahedra, in this order: the one at x = `first` and its neighbour.
mesh::BlockMesh<3> two_cubes(int n, int first) {
  mesh::BlockMesh<3> mesh;
  for (const int at : {first, 1 - first}) {
    const BodyId body = mesh.bodies.push_back({at == 0 ? "left" : "right", MaterialId{0}, false, {}});
    const std::size_t node = mesh.nodes.size();
    const std::size_t element = mesh.elements.size();
    for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
      mesh.nodes.push_back(Point<3>(at, 0, 0) + Point<3>(i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1) / (n + 1)) / n);
    }
    const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(n + 1), static_cast<std::size_t>((n + 1) * (n + 1))};
    for (int i = 0; i < n * n * n; ++i) {
      const std::size_t low = node + i % n * step[0] + i / n % n * step[1] + i / n / n * step[2];
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}}) {
        mesh.elements.push_back(
            {NodeId{low}, NodeId{low + step[a]}, NodeId{low + step[a] + step[b]}, NodeId{low + step[0] + step[1] + step[2]}});
      }
    }
    mesh.blocks.push_back({body, {node, mesh.nodes.size()}, {element, mesh.elements.size()}});
  }
  return mesh;
}

// VTK takes a point for one of a tetrahedron that lies a thousandth outside.
TEST(StoredField, OfTetrahedraStaysOnItsSideOfAJointInAnyOrderOfTheBodies) {
  const auto value = [](const mesh::BlockMesh<3>& mesh, NodeId node) {
    const bool second = node.index() >= mesh.blocks[BlockId{0}].nodes.size();
    const bool left = mesh.bodies[mesh.blocks[second ? BlockId{1} : BlockId{0}].body].name == "left";
    return 300 + 10 * mesh.nodes[node].x() + (left ? 0 : 500);
  };
  const auto stored = two_cubes(2, 0);
  store(stored, {0}, [&](NodeId node, double) { return value(stored, node); });
  for (const int n : {2, 3, 8}) {
    for (const int first : {0, 1}) {
      const auto mesh = two_cubes(n, first);
      const NodalField field = read_stored({folder(), {}}, mesh);
      for (const NodeId node : mesh.nodes.ids()) {
        EXPECT_NEAR(field.values[node.value()], value(mesh, node), 1e-3) << n << " " << first;
      }
    }
  }
}

// A square frame of a third of its width around a core, both with n cells for a third.
mesh::BlockMesh<2> framed(int n) {
  mesh::BlockMesh<2> mesh;
  for (const bool core : {false, true}) {
    const BodyId body = mesh.bodies.push_back({core ? "core" : "frame", MaterialId{0}, false, {}});
    const std::size_t first = mesh.nodes.size(), first_element = mesh.elements.size();
    std::map<std::pair<int, int>, NodeId> nodes;
    const auto node = [&](int i, int j) {
      const auto [found, is_new] = nodes.try_emplace({i, j}, NodeId{mesh.nodes.size()});
      if (is_new) mesh.nodes.push_back(Point<2>(double(i) / n, double(j) / n));
      return found->second;
    };
    for (int i = 0; i < 3 * n; ++i) {
      for (int j = 0; j < 3 * n; ++j) {
        if ((i / n == 1 && j / n == 1) != core) continue;
        mesh.elements.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
        mesh.elements.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    }
    mesh.blocks.push_back({body, {first, mesh.nodes.size()}, {first_element, mesh.elements.size()}});
  }
  return mesh;
}

// The middle of the frame is in the core.
TEST(StoredField, OfABodyAroundAnotherIsItsOwn) {
  const auto value = [](const mesh::BlockMesh<2>& mesh, NodeId node) {
    return node.index() < mesh.blocks[BlockId{0}].nodes.size() ? 300.0 : 400.0;
  };
  const auto stored = framed(2);
  store(stored, {0}, [&](NodeId node, double) { return value(stored, node); });
  const auto mesh = framed(3);
  const NodalField field = read_stored({folder(), {}}, mesh);
  EXPECT_EQ(field.moved, 0u);
  for (const NodeId node : mesh.nodes.ids()) EXPECT_NEAR(field.values[node.value()], value(mesh, node), 1e-9) << node.value();
}

// A cube of two wedges, and each of its halves as hot as its own corners say.
TEST(StoredField, OfWedgesIsThatOfTheOneAroundTheNode) {
  mesh::BlockMesh<3> stored;
  const BodyId body = stored.bodies.push_back({"cube", MaterialId{0}, false, {}});
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) stored.nodes.push_back({x, y, z});
  }
  // Their diagonal lies where 2 (x - y) bends.
  const std::array<std::array<std::size_t, 6>, 2> wedges{{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}};
  const std::size_t first = stored.elements.size();
  for (const auto& corners : wedges) {
    mesh::Cell cell{mesh::CellKind::wedge, {}};
    for (std::size_t i = 0; i < 6; ++i) cell.nodes[i] = NodeId{corners[i]};
    stored.cells.push_back(cell);
    const auto node = [&](int i) { return cell.nodes[static_cast<std::size_t>(i)]; };
    stored.elements.push_back({node(0), node(1), node(2), node(3)});
    stored.elements.push_back({node(1), node(2), node(3), node(4)});
    stored.elements.push_back({node(2), node(3), node(4), node(5)});
  }
  stored.blocks.push_back({body, {0, stored.nodes.size()}, {first, stored.elements.size()}, {0, 2}});
  const auto value = [](const Point<3>& at) { return 400 + 2 * std::abs(at.x() - at.y()) + at.z(); };
  store(stored, {0}, [&](NodeId node, double) { return value(stored.nodes[node]); });
  for (const auto& [x, y] : {std::pair{0.7, 0.2}, {0.2, 0.7}, {0.9, 0.8}, {0.1, 0.4}}) {
    mesh::BlockMesh<3> one;
    one.bodies.push_back({"point", MaterialId{0}, false, {}});
    const Point<3> at(x, y, 0.5);
    for (const double step : {0.0, 1e-7}) one.nodes.push_back(at + Point<3>(step, 0, 0));
    one.nodes.push_back(at + Point<3>(0, 1e-7, 0));
    one.nodes.push_back(at + Point<3>(0, 0, 1e-7));
    one.elements.push_back({NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}});
    one.blocks.push_back({BodyId{0}, {0, 4}, {0, 1}});
    EXPECT_NEAR(read_stored({folder(), {}}, one).values[0], value(at), 1e-5) << x << ' ' << y;
  }
}

// A disc of quadrilaterals of all shapes. Some of those that may hold a point are looked at from so far outside them that their
// own coordinates of it are not found.
TEST(StoredField, OfADiscOfQuadrilateralsIsLinearWhereTheyAreLinear) {
  mesh::BodySpec disc;
  disc.name = "disc";
  disc.shape = mesh::Sphere{2};
  disc.mesh_size = 0.3;
  disc.cells = mesh::CellKind::quadrilateral;
  const auto stored = mesh::make_blocks<2>({disc});
  const auto value = [](const Point<2>& at) { return 350 + 10 * at.x() + 5 * at.y(); };
  store(stored, {0}, [&](NodeId at, double) { return value(stored.nodes[at]); });
  mesh::BlockMesh<2> points;
  points.bodies.push_back({"points", MaterialId{0}, false, {}});
  constexpr int count = 3000;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.399963 * i, radius = 0.9 * std::sqrt((i + 0.5) / count);  // a sunflower's
    const Point<2> at(radius * std::cos(angle), radius * std::sin(angle));
    const std::size_t first = points.nodes.size();
    for (const Point<2>& corner : {at, Point<2>(at + Point<2>(1e-7, 0)), Point<2>(at + Point<2>(0, 1e-7))}) {
      points.nodes.push_back(corner);
    }
    points.elements.push_back({NodeId{first}, NodeId{first + 1}, NodeId{first + 2}});
    points.blocks.push_back({BodyId{0}, {first, first + 3}, {points.elements.size() - 1, points.elements.size()}});
  }
  const NodalField field = read_stored({folder(), {}}, points);
  for (const NodeId at : points.nodes.ids()) {
    EXPECT_NEAR(field.values[static_cast<Eigen::Index>(at.index())], value(points.nodes[at]), 1e-5);
  }
}

TEST(StoredField, ANodeOutsideNeedsAReach) {
  store(two_squares(3));
  auto mesh = two_squares(4);
  for (Point<2>& node : mesh.nodes) node.y() *= 1.01;
  EXPECT_THAT(wrong_with({folder(), {}}, mesh), HasSubstr("10 nodes lie outside its mesh and a reach of 0 m"));
  const NodalField field = read_stored({folder(), {}, 0.011}, mesh);
  EXPECT_EQ(field.moved, 10u);
  EXPECT_LT(largest_error(field, mesh, 60), 0.0701) << "the nearest point is 0.01 m away, at 7 K/m";
}

TEST(StoredField, WhatCannotBeReadIsSaidWithItsPlace) {
  const auto mesh = two_squares(2);
  store(mesh);
  StoredField stored{folder(), 30.0};
  stored.where = {"s.yaml", 4, 5};
  EXPECT_THAT(wrong_with(stored, mesh), HasSubstr("s.yaml:4:5: heat.initial.from is "));
  EXPECT_THAT(wrong_with(stored, mesh), HasSubstr("has no frame at 30 s; the nearest is at "));
  EXPECT_THAT(wrong_with({folder() / "nothing", {}}, mesh), HasSubstr("Name the output directory"));
  EXPECT_THAT(wrong_with({folder() / "heat" / "heat_000000.vtu", 0.0}, mesh), HasSubstr("is a single frame"));
  EXPECT_THAT(wrong_with({std::string(5000, 'n'), {}}, mesh), HasSubstr("heat.initial.from is nnnn"));
}

}  // namespace

}  // namespace scree::output
