// The surface of a block as one shell of triangles that know their neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// By which an edge may be indented in what counts as convex, of the length of the edges beside it, and a point lie above any
// triangle, of the longest edge.
constexpr double allowed_dent = 1e-3;

// Closed, but not always in one piece.
struct Shell {
  std::vector<Eigen::Vector3d> points;                  // [m]
  std::vector<std::array<std::int32_t, 3>> triangles;   // counter-clockwise seen from outside
  std::vector<Eigen::Vector3d> normals;                 // unit
  std::vector<std::array<std::int32_t, 3>> neighbours;  // across the edge from corner i to corner i + 1
};

// Nothing if an edge belongs to more or fewer than two triangles.
std::optional<Shell> shell_of(const BlockMesh<3>& mesh, BlockId block);

// Whether it is in one piece and has no dents.
bool is_convex(const Shell& shell);

// Triangles reached from `seed` over neighbours for which `same(neighbour)` holds get the number `label`.
template <class Same>
void flood(const Shell& shell, std::int32_t seed, std::int32_t label, std::vector<std::int32_t>& labels, Same same) {
  std::vector<std::int32_t> open{seed};
  labels[seed] = label;
  while (!open.empty()) {
    const std::int32_t t = open.back();
    open.pop_back();
    for (const std::int32_t n : shell.neighbours[t]) {
      if (labels[n] < 0 && same(n)) {
        labels[n] = label;
        open.push_back(n);
      }
    }
  }
}

}  // namespace scree::mesh
