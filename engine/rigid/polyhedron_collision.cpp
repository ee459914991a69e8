#include "engine/rigid/polyhedron_collision.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
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

void place(const PolyhedronShape& shape, const btTransform& pose, PlacedPiece& placed) {
  const btMatrix3x3& r = pose.getBasis();
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) rotation.row(i) = from_bullet(r[i]).transpose();
  const Eigen::Vector3d origin = from_bullet(pose.getOrigin());
  placed.piece = &shape.piece();
  placed.vertices.clear();
  placed.normals.clear();
  for (const auto& vertex : shape.piece().vertices) placed.vertices.emplace_back(rotation * vertex + origin);
  for (const auto& face : shape.piece().faces) placed.normals.emplace_back(rotation * face.normal);
}

// No two points of the pair approach each other faster than this [m/s].
double fastest_approach(const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second) {
  const auto& a = *btRigidBody::upcast(first.getCollisionObject());
  const auto& b = *btRigidBody::upcast(second.getCollisionObject());
  return (a.getLinearVelocity() - b.getLinearVelocity()).length() +
         radius_of(*first.getCollisionShape()) * a.getAngularVelocity().length() +
         radius_of(*second.getCollisionShape()) * b.getAngularVelocity().length();
}

// A piece of a block that may meet something in a direction, by what it is of the block's surface. All is so of a convex block.
class SurfaceSide {
 public:
  SurfaceSide(const btCollisionObjectWrapper& piece, const Eigen::Vector3d& direction)
      : piece_(static_cast<const PolyhedronShape&>(*piece.getCollisionShape()).piece()),
        direction_(from_bullet(piece.getWorldTransform().getBasis().transpose() * to_bullet(direction))) {
    const btCollisionShape* block = piece.getCollisionObject()->getCollisionShape();
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

}  // namespace

double reach_of(const ContactRanges& ranges, const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second,
                double time_step) {
  return ranges.near + fastest_approach(first, second) * time_step;
}

PolyhedronCollision::Pair PolyhedronCollision::pair_of(const btCollisionObjectWrapper& first,
                                                       const btCollisionObjectWrapper& second, double time_step) const {
  return {&first, &second, reach_of(ranges_, first, second, time_step), time_step};
}

void PolyhedronCollision::processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                                           const btDispatcherInfo& info, btManifoldResult* result) {
  const Pair pair = pair_of(*first, *second, info.m_timeStep);
  if (const auto contact = look(pair)) {
    claim(first->getCollisionObject(), second->getCollisionObject(), *contact);
    take(pair, *contact);
  }
  if (manifold_ != nullptr) result->setPersistentManifold(manifold_);
}

std::optional<ContactPoints> PolyhedronCollision::look(const Pair& pair) {
  const btTransform relative = pair.first->getWorldTransform().inverseTimes(pair.second->getWorldTransform());
  if (!still_valid(pair, relative)) {
    relative_ = relative;
    moved_ = 0;
    return evaluate(pair);
  }
  if (manifold_ != nullptr) move_points(pair, false);
  return std::nullopt;
}

void PolyhedronCollision::claim(const btCollisionObject* first, const btCollisionObject* second, const ContactPoints& contact) {
  if (contact.count == 0) {
    drop_manifold();
  } else if (manifold_ == nullptr) {
    manifold_ = m_dispatcher->getNewManifold(first, second);
  }
}

bool PolyhedronCollision::still_valid(const Pair& pair, const btTransform& relative) {
  if (evaluated_reach_ < 0) return false;
  const auto& b = static_cast<const PolyhedronShape&>(*pair.second->getCollisionShape());
  moved_ = way_moved(relative_, relative, b.radius());
  if (separation_.distance - moved_ > pair.reach) return true;
  return moved_ < ranges_.still && pair.reach <= std::max(evaluated_reach_, 1.5 * ranges_.near);
}

// Each block may have been on the one side of its home and be on the other later. What still_valid takes for the way moved
// grows with the turn of the first block, times the distance to the second one's centre and its radius.
bool PolyhedronCollision::far(const Pair& pair) const {
  const double first = static_cast<const PolyhedronShape&>(*pair.first->getCollisionShape()).radius();
  const double second = static_cast<const PolyhedronShape&>(*pair.second->getCollisionShape()).radius();
  const double arm = relative_.getOrigin().length() + moved_ + 4 * ranges_.home + second;
  const double moved_more = 2 * ranges_.home * (1 + std::max(1.0, arm / first));
  const double reach = ranges_.near + 2 * ranges_.home;
  return manifold_ == nullptr && separation_.distance - moved_ > 1.01 * (reach + moved_more);
}

bool PolyhedronCollision::on_surfaces(const Pair& pair, const packing::Separation& at) const {
  using Feature = packing::Separation::Feature;
  const SurfaceSide first(*pair.first, at.normal), second(*pair.second, -at.normal);
  switch (at.feature) {
    case Feature::face_of_first:
      return first.parts_at_face(at.of_first) && second.stands_out(ranges_.still);
    case Feature::face_of_second:
      return second.parts_at_face(at.of_second) && first.stands_out(ranges_.still);
    case Feature::edges:
      return first.parts_at_edge(at.of_first) && second.parts_at_edge(at.of_second);
  }
  std::abort();
}

ContactPoints PolyhedronCollision::evaluate(const Pair& pair) {
  static thread_local PlacedPiece a;
  static thread_local PlacedPiece b;
  place(static_cast<const PolyhedronShape&>(*pair.first->getCollisionShape()), pair.first->getWorldTransform(), a);
  place(static_cast<const PolyhedronShape&>(*pair.second->getCollisionShape()), pair.second->getWorldTransform(), b);
  const double enough = pair.reach + ranges_.near;
  if (evaluated_reach_ >= 0) separation_.distance = packing::separation_along(a, b, separation_);
  if (evaluated_reach_ < 0 || separation_.distance <= enough)
    separation_ = packing::separation(a, b, enough, ranges_.face_bias);
  evaluated_reach_ = pair.reach;
  if (separation_.distance > pair.reach) return {};
  if (only_surfaces_ && !on_surfaces(pair, separation_)) {
    // A block that slides over another's pieces comes upon the faces between them from the side, which are not there. What is
    // deep inside is pushed out by any face, lest it falls through.
    const auto real =
        packing::separation_by(a, b, ranges_.face_bias, [&](const packing::Separation& at) { return on_surfaces(pair, at); });
    if (separation_.distance > 0 && real.distance <= 0) return {};
    if (real.distance > -ranges_.near) separation_ = real;
  }
  return contact_points(a, b, separation_, pair.reach, ranges_.clearance);
}

void PolyhedronCollision::take(const Pair& pair, const ContactPoints& contact) {
  if (contact.count == 0) return;
  const auto* first = pair.first->getCollisionObject();
  const auto* second = pair.second->getCollisionObject();
  std::array<btManifoldPoint, 4> old;
  const int old_count = manifold_->getNumContacts();
  for (int i = 0; i < old_count; ++i) old[i] = manifold_->getContactPoint(i);

  normal_ = pair.first->getWorldTransform().getBasis().transpose() * -to_bullet(separation_.normal);
  // The friction direction turns as little as the normal lets it, so that the impulses of the last step still fit.
  tangent_ -= normal_ * normal_.dot(tangent_);
  if (tangent_.length2() < 0.25) {
    btVector3 unused;
    btPlaneSpace1(normal_, tangent_, unused);
  }
  tangent_.normalize();
  manifold_->setNumContacts(contact.count);
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& at = contact.points[i];
    btManifoldPoint& point = manifold_->getContactPoint(i);
    point = btManifoldPoint(first->getWorldTransform().invXform(to_bullet(at.on_first)),
                            second->getWorldTransform().invXform(to_bullet(at.on_second)), btVector3(0, 0, 0), at.distance);
    point.m_contactPointFlags = BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
    point.m_combinedFriction = std::min(first->getFriction(), second->getFriction());
    set_bounce(pair, point, at);
  }
  inherit_impulses(old, old_count, 0.05 * static_cast<const PolyhedronShape&>(*pair.first->getCollisionShape()).radius());
  move_points(pair, true);
}

// Bullet lets a pair close its gap within the step and takes that from the rebound, and lets a pair rebound that will not touch
// yet. A point that is going to bounce in this step is therefore said to touch already, so that it leaves with exactly the
// speed its restitution asks for, and one that is not has no restitution.
void PolyhedronCollision::set_bounce(const Pair& pair, btManifoldPoint& point, const ContactPoint& at) const {
  const btCollisionObject* first = pair.first->getCollisionObject();
  const btCollisionObject* second = pair.second->getCollisionObject();
  const double restitution = std::min(first->getRestitution(), second->getRestitution());
  if (restitution <= 0) return;
  const auto velocity = [](const btCollisionObject* object, const Eigen::Vector3d& point_of) {
    const btVector3 arm = to_bullet(point_of) - object->getWorldTransform().getOrigin();
    return from_bullet(btRigidBody::upcast(object)->getVelocityInLocalPoint(arm));
  };
  const double approach = separation_.normal.dot(velocity(first, at.on_first) - velocity(second, at.on_second));
  if (approach <= ranges_.bounce_speed || at.distance - ranges_.clearance > approach * pair.time_step) return;
  point.m_distance1 = std::min(at.distance, ranges_.clearance);
  point.m_combinedRestitution = restitution;
}

// Each new point takes the impulses of the nearest old one that no nearer point took.
void PolyhedronCollision::inherit_impulses(const std::array<btManifoldPoint, 4>& old, int old_count, double near) {
  std::array<bool, 4> taken{};
  std::array<bool, 4> served{};
  for (int round = 0; round < old_count; ++round) {
    double nearest = near * near;
    int from = -1;
    int to = -1;
    for (int i = 0; i < manifold_->getNumContacts(); ++i) {
      for (int j = 0; j < old_count; ++j) {
        if (served[i] || taken[j]) continue;
        const double distance = (manifold_->getContactPoint(i).m_localPointA - old[j].m_localPointA).length2();
        if (distance >= nearest) continue;
        nearest = distance;
        to = i;
        from = j;
      }
    }
    if (from < 0) return;
    served[to] = taken[from] = true;
    btManifoldPoint& point = manifold_->getContactPoint(to);
    point.m_appliedImpulse = old[from].m_appliedImpulse;
    point.m_appliedImpulseLateral1 = old[from].m_appliedImpulseLateral1;
    point.m_appliedImpulseLateral2 = old[from].m_appliedImpulseLateral2;
  }
}

// The points move with the pair. Their distance follows, exactly so for a pair that does not turn.
void PolyhedronCollision::move_points(const Pair& pair, bool evaluated) {
  const btTransform& first = pair.first->getCollisionObject()->getWorldTransform();
  const btTransform& second = pair.second->getCollisionObject()->getWorldTransform();
  const btVector3 normal = pair.first->getWorldTransform().getBasis() * normal_;
  const btVector3 tangent = pair.first->getWorldTransform().getBasis() * tangent_;
  for (int i = 0; i < manifold_->getNumContacts(); ++i) {
    btManifoldPoint& point = manifold_->getContactPoint(i);
    point.m_positionWorldOnA = first(point.m_localPointA);
    point.m_positionWorldOnB = second(point.m_localPointB);
    point.m_normalWorldOnB = normal;
    if (!evaluated) point.m_distance1 = normal.dot(point.m_positionWorldOnA - point.m_positionWorldOnB);
    point.m_lateralFrictionDir1 = tangent;
    point.m_lateralFrictionDir2 = normal.cross(tangent);
  }
}

void PolyhedronCollision::drop_manifold() {
  if (manifold_ != nullptr) m_dispatcher->releaseManifold(manifold_);
  manifold_ = nullptr;
}

}  // namespace scree::rigid
