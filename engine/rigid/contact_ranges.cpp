#include "engine/rigid/contact_ranges.h"

#include <cmath>

namespace scree::rigid {

namespace {

// A typical length of the free blocks, to which the lengths of the contact search are tied: their mean size [m].
double length_scale(const mesh::BlockMesh<3>& mesh) {
  double sum = 0;
  double count = 0;
  for (const mesh::Block& block : mesh.blocks) {
    if (mesh.bodies[block.body].fixed) continue;
    sum += size_of(mesh, block);
    ++count;
  }
  return count > 0 ? sum / count : 1.0;
}

// Of the mean size of blocks: what a block that is let go beside another one may sink into it in its first step. It is undone
// in those that follow.
constexpr double worth_seeing = 0.03;

}  // namespace

double size_of(const mesh::BlockMesh<3>& mesh, const mesh::Block& block) {
  double volume = 0;
  for (const ElementId e : block.elements) volume += mesh::element_volume(mesh, e);
  return std::cbrt(volume);
}

// The fractions are those measured to work on the pile of 25 mm blocks: 0.25 mm, 0.2 mm, 50 um and, the last, 15 um
// (README.md).
ContactRanges ranges_for(const mesh::BlockMesh<3>& mesh, const SettleOptions& options) {
  const double scale = length_scale(mesh);
  const double bounce_speed = 2 * options.gravity.norm() * options.step;
  // What gravity adds to a block's way within a step is looked for beside it where it is worth looking at.
  const double fall = options.gravity.norm() * options.step * options.step;
  const double fall_seen = fall > worth_seeing * scale ? fall : 0;
  return {.near = 0.01 * scale + options.clearance + fall_seen,
          .face_bias = 0.008 * scale,
          .still = 2e-3 * scale,
          .bounce_speed = bounce_speed,
          .home = 6e-4 * scale,
          .clearance = options.clearance,
          .fall = fall};
}

}  // namespace scree::rigid
