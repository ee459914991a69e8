#include "engine/rigid/bullet_room.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/base/check.h"
#include "engine/packing/penetration.h"
#include "engine/rigid/damping.h"
#include "engine/rigid/fall.h"
#include "engine/rigid/falling_blocks.h"
#include "engine/rigid/polyhedron_shape.h"
#include "engine/rigid/rest.h"
#include "engine/rigid/resting_groups.h"
#include "engine/rigid/scene_bounds.h"
#include "engine/rigid/world.h"

namespace scree::rigid {

namespace {

// Pairs nearer than this part of the mean edge count as touching when the mean penetration is taken.
constexpr double touching_range = 1e-3;

// Drag has done its work when the pile moves slower than this part of the speed at which its blocks fell under it.
constexpr double slow_under_drag = 0.02;

void require(bool good, const char* key, double value, const char* rule) {
  if (good) return;
  Problem problem;
  problem.key = std::string("settle.") + key;
  problem.value = fmt::format("{:g}", value);
  problem.rule = rule;
  throw InputError(problem);
}

void check(const SettleOptions& options) {
  require(options.step > 0, "step", options.step, "positive, s");
  require(options.limit >= 0, "limit", options.limit, "not negative, s");
  require(options.frame_interval > 0, "frame_interval", options.frame_interval, "positive, s");
  require(options.rest_window > 0, "rest_window", options.rest_window, "positive, s");
  require(options.release_time >= 0, "release_time", options.release_time, "not negative, s");
  require(options.iterations > 0, "iterations", options.iterations, "positive");
  require(options.local_damping >= 0 && options.local_damping < 1, "local_damping", options.local_damping, "in [0, 1)");
  require(options.viscous_damping >= 0 && options.viscous_damping * options.step <= 1, "viscous_damping",
          options.viscous_damping, "from 0 to 1 / step, 1/s");
}

// Passes on the poses at t = 0, once per interval, and at the end.
class Frames {
 public:
  Frames(const FrameSink& sink, double interval) : sink_(sink), interval_(interval) {}
  void offer(const World& world, double time) {
    if (!sink_ || time < next_ * (1 - 1e-9)) return;
    sink_(time, world.poses());
    last_ = time;
    next_ = (std::floor(time / interval_ * (1 + 1e-9)) + 1) * interval_;
  }
  void finish(const World& world, double time) {
    if (sink_ && last_ < time) sink_(time, world.poses());
  }

 private:
  const FrameSink& sink_;
  double interval_;
  double next_ = 0;
  double last_ = -1;
};

std::vector<BlockId> take_lost(World& world, const SceneBounds& bounds) {
  std::vector<BlockId> lost;
  for (std::size_t i = 0; i < world.free_blocks().size(); ++i) {
    const BlockId block = world.free_blocks()[i];
    const Eigen::Vector3d centre = from_bullet(world.free_bodies()[i]->getCenterOfMassPosition());
    if (bounds.lost(centre, world.radius(block))) lost.push_back(block);
  }
  for (const BlockId block : lost) world.remove(block);
  return lost;
}

class Settling {
 public:
  Settling(const mesh::BlockMesh<3>& mesh, const Table<MaterialId, Material>& materials, const SettleOptions& options)
      : mesh_(mesh),
        options_(options),
        world_(mesh, materials, options),
        damping_(world_, options.gravity),
        falling_(world_, options.gravity),
        bounds_(mesh, options.gravity) {}

  packing::SettleReport run(const FrameSink& frame, const SettleProgress& progress);
  [[nodiscard]] Table<BlockId, Pose> poses() const { return world_.poses(); }

 private:
  [[nodiscard]] double time() const { return static_cast<double>(half_steps_) * options_.step / 2; }
  Motion advance(double viscous);
  [[nodiscard]] bool has_slowed(const Motion& motion, double viscous) const;
  // Blocks that have only begun to move are slow, too: drag takes 1/c to act.
  [[nodiscard]] bool drag_has_acted(double viscous) const { return time() >= 1 / viscous; }
  [[nodiscard]] double slow_speed(double viscous) const { return slow_under_drag * options_.gravity.norm() / viscous; }
  [[nodiscard]] std::string obstacle(const RestWatch& watch, double viscous) const;

  const mesh::BlockMesh<3>& mesh_;
  const SettleOptions& options_;
  World world_;
  Damping damping_;
  FallingBlocks falling_;
  SceneBounds bounds_;
  std::int64_t half_steps_ = 0;  // time is counted in them, for the last part is made in half steps
  bool halved_ = false;
  double deepest_overlap_ = 0;
  std::vector<BlockId> lost_;
};

bool Settling::has_slowed(const Motion& motion, double viscous) const {
  return drag_has_acted(viscous) && motion.rms_speed < slow_speed(viscous) && !falling_.any(world_);
}

// Why a pile that is not at rest is not, in words and numbers.
std::string Settling::obstacle(const RestWatch& watch, double viscous) const {
  if (world_.hanging() > 0) return fmt::format("{} blocks had not been let go yet", world_.hanging());
  if (viscous == 0) {
    const auto block = falling_.any(world_);
    return watch.obstacle() + (block ? fmt::format(", block {} fell", block->value()) : "");
  }
  if (!drag_has_acted(viscous)) return fmt::format("the drag was still on, for it takes {:.3g} s to act", 1 / viscous);
  if (const auto block = falling_.any(world_)) return fmt::format("the drag was still on, for block {} fell", block->value());
  return fmt::format("the drag was still on, for the root mean square speed had not fallen below {:.3g} m/s yet",
                     slow_speed(viscous));
}

Motion Settling::advance(double viscous) {
  if (world_.hanging() > 0) {
    const auto blocks = static_cast<double>(world_.movable());
    world_.release(static_cast<std::size_t>(std::min(1.0, time() / options_.release_time) * blocks) + 1);
  }
  const double step = halved_ ? options_.step / 2 : options_.step;
  damping_.slow_down(world_, options_.local_damping, viscous, step);
  world_.step(step, options_.iterations);
  damping_.observe(world_, step);
  falling_.observe(world_, damping_);
  deepest_overlap_ = std::max(deepest_overlap_, world_.deepest_overlap());
  half_steps_ += halved_ ? 1 : 2;
  for (const BlockId block : take_lost(world_, bounds_)) lost_.push_back(block);
  return observe_motion(world_, damping_, step);
}

packing::SettleReport Settling::run(const FrameSink& frame, const SettleProgress& progress) {
  Frames frames(frame, options_.frame_interval);
  frames.offer(world_, 0);
  half_steps_ = 2 * skip_free_fall(world_, mesh_, options_,
                                   [&](std::int64_t step) { frames.offer(world_, static_cast<double>(step) * options_.step); });
  packing::SettleReport report;
  report.mean_edge = mesh::mean_edge(mesh_);
  RestWatch watch(world_, options_, report.mean_edge, time());
  RestingGroups groups(world_, options_, report.mean_edge, time());
  double viscous = options_.viscous_damping;
  Motion motion = observe_motion(world_, damping_, options_.step);
  while (!report.at_rest && time() + options_.step <= options_.limit * (1 + 1e-9)) {
    motion = advance(viscous);
    if (progress) progress(time(), motion.rms_speed);
    frames.offer(world_, time());
    const bool rest = watch.observe(world_, motion, time());
    if (viscous == 0) groups.observe(world_, damping_, time());
    report.at_rest = rest && viscous == 0 && world_.hanging() == 0 && !falling_.any(world_);
    if (viscous > 0 && world_.hanging() == 0 && has_slowed(motion, viscous)) {
      viscous = 0;
      halved_ = true;
      world_.scale_impulses(0.5);
      watch = RestWatch(world_, options_, report.mean_edge, time());
      groups = RestingGroups(world_, options_, report.mean_edge, time());
    }
  }
  frames.finish(world_, time());
  report.criterion = watch.criterion();
  if (world_.sleeping() > 0) {
    report.criterion +=
        fmt::format("; {} blocks came to rest before, at a tenth of that, and nothing touched them since", world_.sleeping());
  }
  if (!report.at_rest) report.criterion += "; " + obstacle(watch, viscous);
  report.simulated_time = time();
  report.rms_speed = motion.rms_speed;
  report.max_speed = motion.max_speed;
  report.unbalanced_force = motion.unbalanced;
  report.net_force = damping_.net_forces(world_);
  report.max_displacement = watch.displacement();
  report.window = watch.window();
  report.deepest_overlap = deepest_overlap_;
  std::sort(lost_.begin(), lost_.end());
  report.lost_blocks = lost_;
  return report;
}

}  // namespace

namespace bullet {

packing::Packing<3> settle(const mesh::BlockMesh<3>& blocks, const Table<MaterialId, Material>& materials,
                           const SettleOptions& options, const FrameSink& frame, const SettleProgress& progress) {
  check(options);
  packing::Packing<3> packing = packing::unmoved(blocks);
  Settling settling(blocks, materials, options);
  packing::SettleReport report = settling.run(frame, progress);
  packing.poses = settling.poses();
  const mesh::BlockMesh<3> placed = packing::placed_mesh(packing);
  const packing::Penetration penetration =
      packing::measure_penetration(packing::PieceSet(placed), touching_range * report.mean_edge, report.lost_blocks);
  report.max_penetration = penetration.max;
  report.mean_penetration = penetration.mean;
  report.top = pile_top(placed, options.gravity, report.lost_blocks);
  packing.settled = std::move(report);
  return packing;
}

}  // namespace bullet

}  // namespace scree::rigid
