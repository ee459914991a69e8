#include "engine/mesh/cell_kind.h"

#include <algorithm>

#include "engine/mesh/outer_cell_faces.h"

namespace scree::mesh {

namespace {

template <std::size_t corners>
using Corners = std::array<std::size_t, corners>;

template <std::size_t corners, std::size_t count>
constexpr std::array<CornerList, count> lists(const std::array<Corners<corners>, count>& tables) {
  std::array<CornerList, count> all;
  std::copy(tables.begin(), tables.end(), all.begin());
  return all;
}

namespace quadrilateral {
constexpr std::array<Corners<2>, 4> face_corners{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Corners<3>, 4> simplex_corners{{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}}};
constexpr auto faces = lists(face_corners);
constexpr auto simplices = lists(simplex_corners);
}  // namespace quadrilateral

// The first split has the diagonals 0-4, 2-4 and 0-5, the second 1-3, 1-5 and 2-3. Three pairs of such splits exist, one for
// each edge along the wedge that takes no part in a diagonal of its own; none is better.
namespace wedge {
constexpr std::array<Corners<3>, 2> ends{{{0, 2, 1}, {3, 4, 5}}};
constexpr std::array<Corners<4>, 3> sides{{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<Corners<4>, 6> simplex_corners{
    {{0, 1, 2, 4}, {0, 4, 2, 5}, {0, 4, 5, 3}, {1, 3, 4, 5}, {0, 1, 2, 3}, {1, 5, 2, 3}}};
constexpr std::array<CornerList, 5> faces{ends[0], ends[1], sides[0], sides[1], sides[2]};
constexpr auto simplices = lists(simplex_corners);
}  // namespace wedge

// The first split cuts off the corners 0, 2, 5 and 7 and leaves the tetrahedron of the other four; the second the reverse.
namespace hexahedron {
constexpr std::array<Corners<4>, 6> face_corners{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
constexpr std::array<Corners<4>, 10> simplex_corners{{{0, 1, 3, 4},
                                                      {2, 3, 1, 6},
                                                      {5, 4, 6, 1},
                                                      {7, 6, 4, 3},
                                                      {1, 3, 4, 6},
                                                      {1, 2, 0, 5},
                                                      {3, 0, 2, 7},
                                                      {4, 7, 5, 0},
                                                      {6, 5, 7, 2},
                                                      {0, 2, 7, 5}}};
constexpr auto faces = lists(face_corners);
constexpr auto simplices = lists(simplex_corners);
}  // namespace hexahedron

struct Kind {
  const char* name;
  std::size_t split;
  std::span<const CornerList> faces;
  std::span<const CornerList> simplices;
};

const Kind& about(CellKind kind) {
  static constexpr std::array<Kind, 3> kinds{{{"quadrilateral", 2, quadrilateral::faces, quadrilateral::simplices},
                                              {"wedge", 3, wedge::faces, wedge::simplices},
                                              {"hexahedron", 6, hexahedron::faces, hexahedron::simplices}}};
  return kinds[static_cast<std::size_t>(kind)];
}

}  // namespace

const char* kind_name(CellKind kind) {
  return about(kind).name;
}

std::span<const CornerList> cell_faces(CellKind kind) {
  return about(kind).faces;
}

std::span<const CornerList> mixed_simplices(CellKind kind) {
  return about(kind).simplices;
}

std::size_t split_count(CellKind kind) {
  return about(kind).split;
}

std::span<const std::array<std::size_t, 3>> face_triangles(std::size_t corners) {
  static constexpr std::array<Corners<3>, 1> of_triangle{{{0, 1, 2}}};
  static constexpr std::array<Corners<3>, 4> of_quadrilateral{{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}}};
  if (corners == 3) return of_triangle;
  return of_quadrilateral;
}

}  // namespace scree::mesh
