#include "engine/rigid/polyhedron_collision.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "engine/rigid/homes.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

using packing::PlacedPiece;

// A piece of a block that may meet something in a direction, by what it is of the block's surface. All is so of a convex block.
class SurfaceSide {
 public:
  SurfaceSide(const Side& side, const Eigen::Vector3d& direction)
      : piece_(side.shape()), direction_(from_bullet(side.block->pose.getBasis().transpose() * to_bullet(direction))) {
    const btCollisionShape* block = side.block->body->getCollisionShape();
    if (block->isCompound()) compound_ = static_cast<const CompoundShape*>(block);
  }

  [[nodiscard]] bool parts_at_face(std::int32_t face) const { return !piece_.faces[face].inner; }

  // The direction must lie between the normals beside the edge.
  [[nodiscard]] bool parts_at_edge(std::int32_t number) const {
    if (compound_ == nullptr) return true;
    constexpr double rounding = 1e-6;
    const auto& edge = piece_.edges[number];
    const double widest = edge.beside[0].dot(edge.beside[1]) - rounding;
    return !edge.inner && direction_.dot(edge.beside[0]) > widest && direction_.dot(edge.beside[1]) > widest;
  }

  // One of the foremost corners, up to `slack` behind the first [m], is a corner of the block's that stands out.
  [[nodiscard]] bool stands_out(double slack) const {
    if (compound_ == nullptr) return true;
    double foremost = -std::numeric_limits<double>::infinity();
    for (const auto& vertex : piece_.vertices) foremost = std::max(foremost, direction_.dot(vertex));
    for (std::size_t i = 0; i < piece_.vertices.size(); ++i) {
      if (direction_.dot(piece_.vertices[i]) >= foremost - slack && compound_->stands_out(piece_.nodes[i], direction_))
        return true;
    }
    return false;
  }

 private:
  const mesh::ConvexPiece& piece_;
  Eigen::Vector3d direction_;                // in the block's frame
  const CompoundShape* compound_ = nullptr;  // null: a convex block
};

// How far two blocks must come for one to be through the other, or of the radius of the smaller one: plates are thinner [m].
double size_to_pass(const Side& first, const Side& second) {
  return std::min({first.radius, second.radius, first.polyhedron().thickness() + second.polyhedron().thickness()});
}

double restitution_of(const Side& first, const Side& second) {
  return std::min(first.block->body->getRestitution(), second.block->body->getRestitution());
}

}  // namespace

double reach_of(const ContactRanges& ranges, const Side& first, const Side& second, double time_step) {
  return ranges.near + fastest_approach(first, second) * time_step;
}

void OwnCollision::processCollision(const btCollisionObjectWrapper*, const btCollisionObjectWrapper*, const btDispatcherInfo&,
                                    btManifoldResult*) {
  std::abort();
}

PolyhedronCollision::Pair PolyhedronCollision::pair_of(const Side& first, const Side& second, double time_step) const {
  // Of the radius of the smaller one, which may be a pebble beside a few boulders, whose mean size the ranges go by.
  constexpr double most_bias = 0.05;
  constexpr double most_still = 0.0125;
  const double size = std::min(first.radius, second.radius);
  return {first,
          second,
          reach_of(ranges_, first, second, time_step),
          time_step,
          std::min(ranges_.face_bias, most_bias * size),
          std::min(ranges_.still, most_still * size)};
}

void PolyhedronCollision::claim(const BlockMotion& first, const BlockMotion& second, const ContactPoints& points) {
  if (points.count == 0) {
    drop_contact();
  } else if (contact_ == nullptr) {
    contact_ = &contacts_.add({first.body->getUserIndex(), second.body->getUserIndex()});
  }
}

bool PolyhedronCollision::still_holds(const Pair& pair) {
  const btTransform relative = pair.first.block->pose.inverseTimes(pair.second.block->pose);
  if (evaluated_reach_ >= 0) {
    moved_ = way_moved(relative_, relative, pair.second.radius);
    if (separation_.distance - moved_ > pair.reach) return true;
    if (moved_ < pair.still && !may_bounce(pair) && pair.reach <= std::max(evaluated_reach_, 1.5 * ranges_.near)) return true;
  }
  relative_ = relative;
  moved_ = 0;
  return false;
}

// Whether points rebound is decided where they are made.
bool PolyhedronCollision::may_bounce(const Pair& pair) const {
  return pair.reach - ranges_.near > ranges_.bounce_speed * pair.time_step && restitution_of(pair.first, pair.second) > 0;
}

// Each block may have been on the one side of its home and be on the other later. What still_holds takes for the way moved
// grows with the turn of the first block, times the distance to the second one's centre and its radius.
bool PolyhedronCollision::far(const Pair& pair) const {
  const double arm = relative_.getOrigin().length() + moved_ + 4 * ranges_.home + pair.second.radius;
  const double moved_more = 2 * ranges_.home * (1 + std::max(1.0, arm / pair.first.radius));
  const double reach = ranges_.near + 2 * ranges_.home;
  return contact_ == nullptr && separation_.distance - moved_ > 1.01 * (reach + moved_more);
}

bool PolyhedronCollision::on_surfaces(const Pair& pair, const packing::Separation& at) const {
  using Feature = packing::Separation::Feature;
  const SurfaceSide first(pair.first, at.normal), second(pair.second, -at.normal);
  switch (at.feature) {
    case Feature::face_of_first:
      return first.parts_at_face(at.of_first) && second.stands_out(pair.still);
    case Feature::face_of_second:
      return second.parts_at_face(at.of_second) && first.stands_out(pair.still);
    case Feature::edges:
      return first.parts_at_edge(at.of_first) && second.parts_at_edge(at.of_second);
  }
  std::abort();
}

ContactPoints PolyhedronCollision::look(const Pair& pair) {
  static thread_local PlacedPiece of_first, of_second;
  const PlacedPiece &a = placed(pair.first, of_first), &b = placed(pair.second, of_second);
  const double enough = pair.reach + ranges_.near;
  if (evaluated_reach_ >= 0) separation_.distance = packing::separation_along(a, b, separation_);
  if (evaluated_reach_ < 0 || separation_.distance <= enough) separation_ = packing::separation(a, b, enough, pair.face_bias);
  evaluated_reach_ = pair.reach;
  if (separation_.distance > pair.reach) return {};
  if (only_surfaces_ && !on_surfaces(pair, separation_)) {
    // A block that slides over another's pieces comes upon the faces between them from the side, which are not there. What is
    // deep inside is pushed out by any face, lest it falls through.
    const auto real =
        packing::separation_by(a, b, pair.face_bias, [&](const packing::Separation& at) { return on_surfaces(pair, at); });
    if (separation_.distance > 0 && real.distance <= 0) return {};
    const bool none = real.distance <= -ranges_.near;
    if (none && separation_.distance > -ranges_.near) return {};
    if (!none) separation_ = real;
  }
  ContactPoints points = points_at(pair, a, b, separation_, pair.reach);
  if (separation_.distance <= ranges_.clearance) return points;
  if (points.count == 0) return met_on_the_way(pair, a, b);
  if (passes_by(pair, points)) let_pass(pair, points);
  return points;
}

// A point holds a block before a plane that goes on beyond the face it is of, and one that comes nearer as it flies past would
// strike it there. Whether the pair would touch nowhere on its way through the step, gravity's share of it aside.
bool PolyhedronCollision::passes_by(const Pair& pair, const ContactPoints& points) const {
  constexpr double sideways = 0.01;  // of the radius of the smaller one: too little to be past a face by more than its rim
  constexpr double between = 0.25;   // two looks, of the size to pass
  constexpr double most_looks = 64;
  const double touching = ranges_.clearance + ranges_.fall;
  const double nearer = pair.reach - ranges_.near;  // within the step, the most [m]
  const double size = std::min(pair.first.radius, pair.second.radius);
  if (separation_.distance <= touching || separation_.distance > touching + nearer || nearer < sideways * size) return false;
  const bool closes = std::any_of(points.points.begin(), points.points.begin() + points.count,
                                  [&](const ContactPoint& point) { return point.distance < room_needed(pair, point); });
  if (!closes) return false;
  static thread_local PlacedPiece of_first, of_second;
  const auto touches_after = [&](double time) {
    const PlacedPiece &a = placed_after(pair.first, time, of_first), &b = placed_after(pair.second, time, of_second);
    return packing::separation(a, b, touching, pair.face_bias).distance <= touching;
  };
  const double enough = std::ceil(nearer / (between * size_to_pass(pair.first, pair.second)));
  const double looks = std::clamp(enough, 4.0, most_looks);
  for (double look = looks; look >= 1; --look) {  // most that touch do so at the end
    if (touches_after(look / looks * pair.time_step)) return false;
  }
  if (enough <= looks) return true;
  // So fast that it may be through between two looks: when a point comes to the plane.
  return std::none_of(points.points.begin(), points.points.begin() + points.count, [&](const ContactPoint& point) {
    const double way = point.distance - ranges_.clearance, speed = approach(pair, point);
    return way > 0 && way < speed * pair.time_step && touches_after(way / speed);
  });
}

// The points are as far apart as the pair comes nearer by itself. What others push it nearer by is still held.
void PolyhedronCollision::let_pass(const Pair& pair, ContactPoints& points) const {
  for (int i = 0; i < points.count; ++i) {
    ContactPoint& point = points.points[i];
    point.distance = std::max(point.distance, room_needed(pair, point));
  }
}

// How far apart a point must be for the pair not to touch there within the step, by its own motion and gravity's [m].
double PolyhedronCollision::room_needed(const Pair& pair, const ContactPoint& at) const {
  return ranges_.clearance + ranges_.fall + approach(pair, at) * pair.time_step;
}

// Of the two blocks at a point, along the normal [m/s].
double PolyhedronCollision::approach(const Pair& pair, const ContactPoint& at) const {
  const auto velocity = [](const btRigidBody& body, const Eigen::Vector3d& point_of) {
    return from_bullet(body.getVelocityInLocalPoint(to_bullet(point_of) - body.getWorldTransform().getOrigin()));
  };
  return separation_.normal.dot(velocity(*pair.first.block->body, at.on_first) -
                                velocity(*pair.second.block->body, at.on_second));
}

ContactPoints PolyhedronCollision::points_at(const Pair& pair, const PlacedPiece& first, const PlacedPiece& second,
                                             const packing::Separation& at, double range) const {
  constexpr double rim = 5e-4;  // of the radius of the smaller one: more than blocks at rest are deep in each other
  return contact_points(first, second, at, {range, ranges_.clearance, rim * std::min(pair.first.radius, pair.second.radius)});
}

// Two blocks whose faces are not over each other yet may be past each other when the step ends, if it takes them as far as
// their size. They are looked at where the first one has come to touch the second on its way, and what is found there is said
// of where they are now. Turns are left out.
ContactPoints PolyhedronCollision::met_on_the_way(const Pair& pair, const PlacedPiece& first, const PlacedPiece& second) {
  constexpr double long_way = 0.5;  // of the size to pass
  constexpr double between = 0.25;  // two looks, likewise
  constexpr double most_looks = 200;
  constexpr int halvings = 4;  // of what is between two looks: the two are a sixtieth of the size deep in each other then
  const Eigen::Vector3d way = pair.time_step * from_bullet(pair.first.block->velocity - pair.second.block->velocity);
  const double size = size_to_pass(pair.first, pair.second);
  if (way.norm() < long_way * size) return {};
  const double step = 1 / std::min(most_looks, std::ceil(way.norm() / (between * size)));
  const auto meets = [&](double part) {
    return packing::separation(packing::shifted(first, part * way), second, 0, pair.face_bias).distance <= 0;
  };
  double part = step;
  while (part <= 1 + 0.5 * step && !meets(part)) part += step;
  if (part > 1 + 0.5 * step) return {};
  double half = 0.5 * step;
  for (int halving = 0; halving < halvings; ++halving, half *= 0.5) {
    if (meets(part - half)) part -= half;
  }
  const PlacedPiece there = packing::shifted(first, part * way);
  packing::Separation met = packing::separation(there, second, std::numeric_limits<double>::infinity(), pair.face_bias);
  if (only_surfaces_ && !on_surfaces(pair, met)) return {};
  ContactPoints points = points_at(pair, there, second, met, ranges_.near);
  const double closes = met.normal.dot(part * way);
  for (int i = 0; i < points.count; ++i) {
    points.points[i].on_first -= part * way;
    points.points[i].distance += closes;
  }
  met.distance += closes;
  if (points.count > 0) separation_ = met;
  return points;
}

void PolyhedronCollision::take(const Pair& pair, const ContactPoints& points) {
  if (points.count == 0) return;
  const BlockMotion &first = *pair.first.block, &second = *pair.second.block;
  const auto old = contact_->points;
  const int old_count = contact_->count;

  const btVector3 normal = first.pose.getBasis().transpose() * -to_bullet(separation_.normal);
  // The friction direction turns as little as the normal lets it, so that the impulses of the last step still fit.
  tangent_ -= normal * normal.dot(tangent_);
  if (tangent_.length2() < 0.25) {
    btVector3 unused;
    btPlaneSpace1(normal, tangent_, unused);
  }
  tangent_.normalize();
  contact_->normal = from_bullet(normal);
  contact_->tangent = from_bullet(tangent_);
  contact_->friction = std::min(first.body->getFriction(), second.body->getFriction());
  contact_->count = points.count;
  contact_->fresh = true;
  for (int i = 0; i < points.count; ++i) {
    const ContactPoint& at = points.points[i];
    HeldPoint& point = contact_->points[i] = {};
    point.on_first = from_bullet(first.pose.invXform(to_bullet(at.on_first)));
    point.on_second = from_bullet(second.pose.invXform(to_bullet(at.on_second)));
    point.distance = at.distance;
    set_bounce(pair, point, at);
  }
  inherit_impulses(std::span(old).first(old_count), 0.05 * pair.first.radius);
}

// A pair may close its gap within the step, which is taken from its rebound, and one that will not touch yet must not rebound.
// A point that is going to bounce in this step is therefore said to touch already, so that it leaves with exactly the speed its
// restitution asks for, and one that is not has no restitution.
void PolyhedronCollision::set_bounce(const Pair& pair, HeldPoint& point, const ContactPoint& at) const {
  const double restitution = restitution_of(pair.first, pair.second);
  if (restitution <= 0) return;
  const double speed = approach(pair, at);
  if (speed <= ranges_.bounce_speed || at.distance - ranges_.clearance > speed * pair.time_step) return;
  point.distance = std::min(at.distance, ranges_.clearance);
  point.restitution = restitution;
}

// Each new point takes the impulses of the nearest old one that no nearer point took.
void PolyhedronCollision::inherit_impulses(std::span<const HeldPoint> old, double near) {
  std::array<bool, 4> taken{};
  std::array<bool, 4> served{};
  for (std::size_t round = 0; round < old.size(); ++round) {
    double nearest = near * near;
    int from = -1;
    int to = -1;
    for (int i = 0; i < contact_->count; ++i) {
      for (int j = 0; j < static_cast<int>(old.size()); ++j) {
        if (served[i] || taken[j]) continue;
        const double distance = (contact_->points[i].on_first - old[j].on_first).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        to = i;
        from = j;
      }
    }
    if (from < 0) return;
    served[to] = taken[from] = true;
    contact_->points[to].impulses = old[from].impulses;
  }
}

void PolyhedronCollision::drop_contact() {
  if (contact_ != nullptr) contacts_.remove(*contact_);
  contact_ = nullptr;
}

}  // namespace scree::rigid
