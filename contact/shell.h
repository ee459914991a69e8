// What the coarse search works on: shells, each the boundary faces of one element. They share their corners, so that one table
// of heights serves all pairs of faces of two shells, and the element lies behind all of their planes, so that what is beyond
// one of them is far from the shell.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "contact/surface.h"

namespace scree::contact {

// The edges of a tetrahedron, as vertices, and the two vertices beside each.
struct ElementEdge {
  int start, end, left, right;
};
inline constexpr std::array<ElementEdge, 6> element_edges = {
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

// The sides of a shell's faces (3 face + side) that are an edge of its element; -1 if there is none.
struct EdgeSides {
  std::array<std::int8_t, 2> sides{-1, -1};
  std::int8_t first = -1;  // the one in which the edge is searched; in another shell if its first face is there
};

template <int dim>
struct Shell {
  std::array<std::array<double, dim + 1>, dim> at;  // coordinates of the element's vertices, axis by axis
  std::array<Point<dim>, dim + 1> normals;          // of the faces; those beyond `faces` are unused
  std::array<double, dim + 1> offsets;              // of the faces' planes: normal . x = offset [m]
  double reach = 0;                                 // tolerance, over the faces' semi-springs [m]
  double shift = 0;                                 // no semi-edge is further from its edge [m]
  FaceId first;                                     // the faces are consecutive
  std::int32_t faces = 0;
  BlockId block;
  bool whole = false;                                         // the block has no other element
  std::array<std::array<std::int8_t, dim>, dim + 1> corners;  // of each face, as vertices
  std::array<EdgeSides, dim == 3 ? 6 : 0> edges;              // of each of element_edges
  double longest = 0;                                         // edge [m]

  [[nodiscard]] Point<dim> vertex(int v) const {
    Point<dim> point;
    for (int i = 0; i < dim; ++i) point[i] = at[i][v];
    return point;
  }
  [[nodiscard]] FaceId face(int i) const { return FaceId{first.index() + static_cast<std::size_t>(i)}; }
};

// Heights of the vertices of one shell above the planes of another.
template <int dim>
using Heights = std::array<std::array<double, dim + 1>, dim + 1>;

template <int dim>
void heights_above(const Shell<dim>& planes, int face, const Shell<dim>& of, std::array<double, dim + 1>& heights) {
  const Point<dim>& normal = planes.normals[face];
  for (int v = 0; v <= dim; ++v) heights[v] = -planes.offsets[face];
  for (int i = 0; i < dim; ++i) {
    for (int v = 0; v <= dim; ++v) heights[v] += normal[i] * of.at[i][v];
  }
}

template <int dim>
Heights<dim> heights_above(const Shell<dim>& planes, const Shell<dim>& of) {
  Heights<dim> heights;
  for (int f = 0; f < planes.faces; ++f) heights_above(planes, f, of, heights[f]);
  return heights;
}

// The same, unless one of the planes has the whole shell more than `distance` above it: then returns false.
template <int dim>
bool heights_within(const Shell<dim>& planes, const Shell<dim>& of, double distance, Heights<dim>& heights) {
  for (int f = 0; f < planes.faces; ++f) {
    heights_above(planes, f, of, heights[f]);
    double lowest = heights[f][0];
    for (int v = 1; v <= dim; ++v) lowest = std::min(lowest, heights[f][v]);
    if (lowest > distance) return false;
  }
  return true;
}

// How the search looks at a face: how far it reaches, in characteristic lengths, and how far its semi-springs are moved.
struct ShellOptions {
  double tolerance = 0;
  double indentation = 0;
};

// The first face of every shell, in order, and the number of faces behind them.
template <int dim>
std::vector<FaceId> shell_starts(const Surface<dim>& surface);

template <int dim>
Shell<dim> make_shell(const Surface<dim>& surface, FaceId first, FaceId end, const ShellOptions& options);

}  // namespace scree::contact
