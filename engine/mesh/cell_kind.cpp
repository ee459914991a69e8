#include "engine/mesh/cell_kind.h"

#include "engine/mesh/outer_cell_faces.h"

namespace scree::mesh {

namespace {

template <std::size_t corners>
using Corners = std::array<std::size_t, corners>;

struct Kind {
  const char* name;
  std::size_t corners;
  std::size_t split;
  std::vector<CornerList> faces;
  std::vector<CornerList> simplices;
};

template <class Tables>
std::vector<CornerList> lists(const Tables& tables) {
  return std::vector<CornerList>(tables.begin(), tables.end());
}

const Kind& quadrilateral() {
  static constexpr std::array<Corners<2>, 4> faces{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  static constexpr std::array<Corners<3>, 4> simplices{{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 0}}};
  static const Kind kind{"quadrilateral", 4, 2, lists(faces), lists(simplices)};
  return kind;
}

// The first split has the diagonals 0-4, 2-4 and 0-5, the second 1-3, 1-5 and 2-3. Three pairs of such splits exist, one for
// each edge along the wedge that takes no part in a diagonal of its own; none is better.
const Kind& wedge() {
  static constexpr std::array<Corners<3>, 2> ends{{{0, 2, 1}, {3, 4, 5}}};
  static constexpr std::array<Corners<4>, 3> sides{{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
  static constexpr std::array<Corners<4>, 6> simplices{
      {{0, 1, 2, 4}, {0, 4, 2, 5}, {0, 4, 5, 3}, {1, 3, 4, 5}, {0, 1, 2, 3}, {1, 5, 2, 3}}};
  static const Kind kind = [] {
    Kind made{"wedge", 6, 3, lists(ends), lists(simplices)};
    made.faces.insert(made.faces.end(), sides.begin(), sides.end());
    return made;
  }();
  return kind;
}

// The first split cuts off the corners 0, 2, 5 and 7 and leaves the tetrahedron of the other four; the second the reverse.
const Kind& hexahedron() {
  static constexpr std::array<Corners<4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  static constexpr std::array<Corners<4>, 10> simplices{{{0, 1, 3, 4},
                                                         {2, 3, 1, 6},
                                                         {5, 4, 6, 1},
                                                         {7, 6, 4, 3},
                                                         {1, 3, 4, 6},
                                                         {1, 2, 0, 5},
                                                         {3, 0, 2, 7},
                                                         {4, 7, 5, 0},
                                                         {6, 5, 7, 2},
                                                         {0, 2, 7, 5}}};
  static const Kind kind{"hexahedron", 8, 6, lists(faces), lists(simplices)};
  return kind;
}

const Kind& about(CellKind kind) {
  if (kind == CellKind::quadrilateral) return quadrilateral();
  return kind == CellKind::wedge ? wedge() : hexahedron();
}

}  // namespace

std::size_t corner_count(CellKind kind) {
  return about(kind).corners;
}

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
