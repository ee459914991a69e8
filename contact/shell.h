// What the coarse search works on: shells, each the boundary faces of one element. The element lies behind all of its planes,
// inner faces' too, so that what is beyond one of them is that far from the shell at least.
//
// Vertex i of a shell is that of its element, and plane and face i are opposite to it. Places are in single precision from the
// element's centre, so that rounding is that of the element's size and not of its distance from the origin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "contact/lanes.h"
#include "contact/surface.h"

namespace scree::contact {

template <int dim>
struct Shell {
  LanePoints<dim> at;       // the vertices, a lane each [m]; in 2-D the last lane repeats the first, here and below
  LanePoints<dim> normals;  // of the planes, unit, outwards
  Lanes offsets;            // of the planes: normal . x = offset [m]
  Point<dim> centre;        // [m]
  float radius = 0;         // no vertex is further from the centre [m]
  float reach = 0;          // tolerance, over the faces' semi-springs [m]
  float shift = 0;          // no semi-edge is further from its edge [m]
  float length = 0;         // characteristic, of the element [m]
  BlockId block;
  FaceId first;            // the boundary faces are consecutive, in the order of their planes
  std::uint8_t faces = 0;  // bit i: face i is a boundary face
  std::uint8_t open = 0;   // of these: the targets of its semi-springs are not known yet
  bool whole = false;      // the block has no other element
  std::uint8_t edges = 0;  // 3-D. Bit i: edge i of tetrahedron.h is a target edge that is searched here; each is, once
  std::array<EdgeId, dim == 3 ? 6 : 0> targets;  // the ids of those

  [[nodiscard]] FaceId face(int i) const {
    // How many bits are set in a number up to 7, two bits for each such number.
    constexpr unsigned set_bits = 0b1110'1001'1001'0100;
    const unsigned before = faces & ((1u << i) - 1);
    return FaceId{first.index() + (set_bits >> 2 * before & 3u)};
  }
};

// Where the second of two shells is as seen from the first.
template <int dim>
struct Way {
  Way() = default;
  Way(const Shell<dim>& from, const Shell<dim>& to) {
    // Some ten roundings of single precision, each of a length in this sum.
    constexpr float unit = 2e-6F;
    rounding = from.radius + to.radius;
    for (int i = 0; i < dim; ++i) {
      axes[i] = static_cast<float>(to.centre[i] - from.centre[i]);
      rounding += std::abs(axes[i]);
    }
    rounding *= unit;
  }

  std::array<float, dim> axes;  // [m]
  float rounding = 0;           // no height or distance is off by more [m]
};

// What touches is nearer than this: a semi-edge may touch in place of its edge.
template <int dim>
float slack(const Shell<dim>& a, const Shell<dim>& b) {
  return std::max(a.reach + a.shift, b.reach + b.shift);
}

// How the search looks at a face: how far it reaches, in characteristic lengths, and how far its semi-springs are moved.
struct ShellOptions {
  double tolerance = 0;
  double indentation = 0;
};

// A semi-edge is a third of its face's height from its edge, times the indentation, and no height is larger than the diagonal
// of the face's box.
inline constexpr double widest_shift = 0.34;

// The first face of every shell, in order, and the number of faces behind them.
template <int dim>
std::vector<FaceId> shell_starts(const Surface<dim>& surface);

template <int dim>
Shell<dim> make_shell(const Surface<dim>& surface, FaceId first, FaceId end, const ShellOptions& options);

}  // namespace scree::contact
