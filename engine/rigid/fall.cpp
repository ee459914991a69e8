#include "engine/rigid/fall.h"

#include <cmath>
#include <optional>

namespace scree::rigid {

namespace {

struct Motion {
  Eigen::Vector3d way;       // [m]
  Eigen::Vector3d velocity;  // [m/s]
};

Motion fallen(const Eigen::Vector3d& start_velocity, const SettleOptions& options, double time) {
  const Eigen::Vector3d acceleration = (1 - options.local_damping) * options.gravity;
  const double c = options.viscous_damping;
  if (c == 0) return {start_velocity * time + acceleration * time * time / 2, start_velocity + acceleration * time};
  const Eigen::Vector3d final_velocity = acceleration / c;
  const Eigen::Vector3d excess = start_velocity - final_velocity;
  return {final_velocity * time - excess * std::expm1(-c * time) / c, final_velocity + excess * std::exp(-c * time)};
}

Aabb<3> bounds(const mesh::BlockMesh<3>& mesh, BlockId block) {
  Aabb<3> box;
  for (const NodeId node : mesh.blocks[block].nodes) box.extend(mesh.nodes[node]);
  return box;
}

// The velocity all free blocks start with.
std::optional<Eigen::Vector3d> common_velocity(const mesh::BlockMesh<3>& mesh) {
  std::optional<Eigen::Vector3d> velocity;
  for (const mesh::Block& block : mesh.blocks) {
    const mesh::Body& body = mesh.bodies[block.body];
    if (body.fixed) continue;
    if (velocity && *velocity != body.velocity) return std::nullopt;
    velocity = body.velocity;
  }
  return velocity;
}

}  // namespace

std::int64_t skip_free_fall(World& world, const mesh::BlockMesh<3>& mesh, const SettleOptions& options,
                            const std::function<void(std::int64_t)>& after_step) {
  const std::optional<Eigen::Vector3d> start = common_velocity(mesh);
  // Local damping acts on each component against its own direction: a throw has no closed form.
  if (!start || options.release_time > 0 || (options.local_damping > 0 && !start->isZero())) return 0;
  Aabb<3> moving;
  Aabb<3> scene;
  std::vector<Aabb<3>> fixed;
  for (const BlockId block : mesh.blocks.ids()) {
    const Aabb<3> box = bounds(mesh, block);
    if (mesh.bodies[mesh.blocks[block].body].fixed) {
      fixed.push_back(box);
    } else {
      moving.extend(box);
    }
    scene.extend(box);
  }
  const double clearance = 1e-3 * scene.diagonal().norm();
  // On the whole of its way there from the step before, which may be longer than what is in it.
  const auto clear_after = [&](std::int64_t steps) {
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(clearance);
    Aabb<3> box;
    for (const std::int64_t step : {steps - 1, steps}) {
      const Eigen::Vector3d way = fallen(*start, options, static_cast<double>(step) * options.step).way;
      box.extend(Aabb<3>(moving.min() + way - margin, moving.max() + way + margin));
    }
    bool clear = box.intersects(scene);
    for (const Aabb<3>& obstacle : fixed) clear = clear && !box.intersects(obstacle);
    return clear;
  };
  std::int64_t steps = 0;
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  while (!fixed.empty() && static_cast<double>(steps + 1) * options.step <= options.limit && clear_after(steps + 1)) {
    ++steps;
    const Motion motion = fallen(*start, options, static_cast<double>(steps) * options.step);
    world.translate_free(motion.way - way, motion.velocity);
    way = motion.way;
    after_step(steps);
  }
  return steps;
}

}  // namespace scree::rigid
