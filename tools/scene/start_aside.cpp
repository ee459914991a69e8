// A pile's packing hangs on the last digits of where it starts: a seed moves them, and makes an ensemble of piles.
#include <algorithm>

#include "engine/mesh/random_numbers.h"
#include "engine/mesh/shape_mesh.h"
#include "tools/scene/sections.h"

namespace scree {

namespace {

constexpr double farthest = 1e-3;  // of the mesh size, or the body: far above rounding, far below what anyone measures

void move(mesh::AtPoses& at, const Eigen::Vector3d& way) {
  for (Pose& pose : at.poses) pose.translation += way;
}

void move(mesh::OnLattice& lattice, const Eigen::Vector3d& way) {
  lattice.centre += way;
}

void move(mesh::AtRandom& random, const Eigen::Vector3d& way) {
  random.low += way;
  random.high += way;
}

}  // namespace

void start_aside(const SettleStage& settle, std::vector<mesh::BodySpec>& bodies) {
  if (settle.seed == 0 || settle.options.gravity.isZero()) return;
  const Eigen::Vector3d down = settle.options.gravity.normalized();
  mesh::RandomNumbers random(static_cast<std::uint64_t>(settle.seed));
  for (mesh::BodySpec& body : bodies) {
    if (body.fixed) continue;
    Eigen::Vector3d way;
    const double size = std::min(body.mesh_size, mesh::largest_length(body.shape));
    for (double& component : way) component = farthest * size * random.between(-1, 1);
    // Across gravity, so that bodies placed on each other start no deeper in each other.
    way -= down * down.dot(way);
    std::visit([&](auto& arrangement) { move(arrangement, way); }, body.arrangement);
  }
}

}  // namespace scree
