// A heap of loose tetrahedra on a plate, hot below: something to draw.
#pragma once

#include <cmath>
#include <random>

#include "engine/output/series.h"
#include "tests/output/support.h"

namespace scree::output {

// A plate of `cells` x `cells` boxes, 2 m wide and 5 cm thick, its top at z = 0; one block.
inline void add_plate(mesh::BlockMesh<3>& mesh, BodyId body, int cells) {
  const std::size_t first_node = mesh.nodes.size();
  const std::size_t first_element = mesh.elements.size();
  for (const double z : {-0.05, 0.0}) {
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) mesh.nodes.push_back({-1 + 2.0 * i / cells, -1 + 2.0 * j / cells, z});
    }
  }
  const auto node = [&](int i, int j, int k) {
    return NodeId{first_node + static_cast<std::size_t>((k * (cells + 1) + j) * (cells + 1) + i)};
  };
  // Kuhn's split of a box: one tetrahedron per order of the three steps from one corner to the opposite one.
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      for (int order = 0; order < 6; ++order) {
        int at[3] = {i, j, 0};
        mesh::BlockMesh<3>::Element element{node(at[0], at[1], at[2])};
        for (int step = 0; step < 3; ++step) {
          ++at[orders[order][step]];
          element[step + 1] = node(at[0], at[1], at[2]);
        }
        if (order >= 3) std::swap(element[2], element[3]);
        mesh.elements.push_back(element);
      }
    }
  }
  mesh.blocks.push_back({body, {first_node, mesh.nodes.size()}, {first_element, mesh.elements.size()}});
}

inline mesh::BlockMesh<3> synthetic_pile(int rocks, int plate_cells) {
  mesh::BlockMesh<3> mesh;
  const BodyId plate = mesh.bodies.push_back({"plate", MaterialId{0}, true, {}});
  const BodyId rock = mesh.bodies.push_back({"rock", MaterialId{0}, false, {}});
  add_plate(mesh, plate, plate_cells);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int placed = 0; placed < rocks;) {
    const Point<3> at(0.6 * uniform(random), 0.6 * uniform(random), 0.02 + 0.21 * (1 + uniform(random)));
    if (at.z() > 0.44 * (1 - at.head<2>().norm() / 0.6)) continue;
    Pose pose{at, Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random)).normalized()};
    std::array<Point<3>, 4> corners = unit_tet(Point<3>::Constant(-0.25));
    for (Point<3>& corner : corners) corner = pose * (0.06 * corner);
    add_block<3>(mesh, rock, corners);
    ++placed;
  }
  return mesh;
}

// 373 K below, 298 K above, and which body an element belongs to.
inline Frame warmed_from_below(const mesh::BlockMesh<3>& mesh, double time) {
  Frame frame{time, {}, {}};
  std::vector<double> temperature;
  for (const Point<3>& node : mesh.nodes) temperature.push_back(298.15 + 75 * std::exp(-std::max(0.0, node.z()) / 0.15));
  std::vector<std::int32_t> body;
  for (const BlockId block : mesh::element_blocks(mesh)) body.push_back(mesh.blocks[block].body.value());
  frame.points.push_back({"temperature", 1, temperature});
  frame.cells.push_back({"body", 1, body});
  return frame;
}

}  // namespace scree::output
