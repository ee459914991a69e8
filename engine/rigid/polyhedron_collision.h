// Our narrow phase in Bullet's collision configuration: separating axes and face clipping on the true geometry, no margin.
#pragma once

#include <array>
#include <optional>

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "engine/packing/separation.h"
#include "engine/rigid/contact_points.h"

namespace scree::rigid {

// Lengths of the contact search; the world derives them from the size of the blocks.
struct ContactRanges {
  double near = 0;          // points nearer than this, plus what the pair may approach in a step, become contacts [m]
  double face_bias = 0;     // see packing::separation [m]
  double still = 0;         // a pair that moved less than this since its points were computed keeps them [m]
  double bounce_speed = 0;  // an approach slower than this has no restitution [m/s]
  double home = 0;          // range of Homes [m]
  double clearance = 0;     // at which two blocks touch [m]
};

// How near points of two blocks, or of pieces of theirs, must be to become contacts in a step [m].
double reach_of(const ContactRanges& ranges, const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second,
                double time_step);

// Two polyhedra that may touch.
class PolyhedronCollision final : public btActivatingCollisionAlgorithm {
 public:
  PolyhedronCollision(const btCollisionAlgorithmConstructionInfo& info, const ContactRanges& ranges,
                      const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second)
      : btActivatingCollisionAlgorithm(info, first, second), ranges_(ranges) {}

  // Of pieces of blocks: what they meet at must be a face or edge of the blocks' surfaces.
  void ask_for_surfaces() { only_surfaces_ = true; }

  ~PolyhedronCollision() override { drop_manifold(); }

  void processCollision(const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&, btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (manifold_ != nullptr) manifolds.push_back(manifold_);
  }

  struct Pair {
    const btCollisionObjectWrapper* first;
    const btCollisionObjectWrapper* second;
    double reach;      // how near a point must be to become a contact in this step [m]
    double time_step;  // [s]
  };

  [[nodiscard]] Pair pair_of(const btCollisionObjectWrapper& first, const btCollisionObjectWrapper& second,
                             double time_step) const;
  // Moves the points with the pair, or returns new ones. Touches nothing but its own pair, so that many may look at once.
  [[nodiscard]] std::optional<ContactPoints> look(const Pair& pair);
  // Makes room for new points, or gives up what there was. One at a time, for manifolds come from a common pool.
  void claim(const btCollisionObject* first, const btCollisionObject* second, const ContactPoints& contact);
  // Then takes them over, if there are any. Touches nothing but its own pair.
  void take(const Pair& pair, const ContactPoints& contact);
  // Whether looks will find nothing to do as long as both blocks are at home.
  [[nodiscard]] bool far(const Pair& pair) const;

 private:
  [[nodiscard]] bool still_valid(const Pair& pair, const btTransform& relative);
  [[nodiscard]] ContactPoints evaluate(const Pair& pair);
  [[nodiscard]] bool on_surfaces(const Pair& pair, const packing::Separation& at) const;
  void set_bounce(const Pair& pair, btManifoldPoint& point, const ContactPoint& at) const;
  void inherit_impulses(const std::array<btManifoldPoint, 4>& old, int old_count, double near);
  void move_points(const Pair& pair, bool evaluated);
  void drop_manifold();

  const ContactRanges& ranges_;
  bool only_surfaces_ = false;
  btPersistentManifold* manifold_ = nullptr;
  btTransform relative_;         // pose of the second in the first's frame when evaluated
  double moved_ = 0;             // since then, at most [m]
  double evaluated_reach_ = -1;  // negative: never evaluated
  packing::Separation separation_;
  btVector3 normal_;            // from the second to the first, in the first's frame
  btVector3 tangent_{0, 0, 0};  // first friction direction, in the first's frame
};

}  // namespace scree::rigid
