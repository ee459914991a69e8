// Our narrow phase in Bullet's collision configuration: separating axes and face clipping on the true geometry, no margin.
#pragma once

#include <array>

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>

#include "engine/packing/separation.h"
#include "engine/rigid/block_motion.h"
#include "engine/rigid/contact_points.h"
#include "engine/rigid/contact_ranges.h"
#include "engine/rigid/held_contacts.h"

namespace scree::rigid {

// How near points of two blocks, or of pieces of theirs, must be to become contacts in a step [m].
double reach_of(const ContactRanges& ranges, const Side& first, const Side& second, double time_step);

// What Bullet keeps with a pair. It is not Bullet that asks it to look at the pair, but our dispatcher, and no contact is in
// one of Bullet's manifolds.
class OwnCollision : public btCollisionAlgorithm {
 public:
  using btCollisionAlgorithm::btCollisionAlgorithm;
  void processCollision(const btCollisionObjectWrapper*, const btCollisionObjectWrapper*, const btDispatcherInfo&,
                        btManifoldResult*) final;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&, btManifoldResult*) final {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray&) final {}
};

// Two polyhedra that may touch.
class PolyhedronCollision final : public OwnCollision {
 public:
  PolyhedronCollision(const btCollisionAlgorithmConstructionInfo& info, const ContactRanges& ranges, HeldContacts& contacts)
      : OwnCollision(info), ranges_(ranges), contacts_(contacts) {}

  // Of pieces of blocks: what they meet at must be a face or edge of the blocks' surfaces.
  void ask_for_surfaces() { only_surfaces_ = true; }

  ~PolyhedronCollision() override { drop_contact(); }

  struct Pair {
    Side first, second;
    double reach;      // how near a point must be to become a contact in this step [m]
    double time_step;  // [s]
    double face_bias;  // see packing::separation [m]
    double still;      // the pair keeps its points if it moved less than this since they were computed [m]
  };

  [[nodiscard]] Pair pair_of(const Side& first, const Side& second, double time_step) const;
  // Whether the points it has still hold, if there are any; if not, a look has to follow. This and the next touch nothing but
  // their own pair, so that many may be asked at once.
  [[nodiscard]] bool still_holds(const Pair& pair);
  // New points.
  [[nodiscard]] ContactPoints look(const Pair& pair);
  // Makes room for new points, or gives up what there was. One at a time, for contacts come from a common pool.
  void claim(const BlockMotion& first, const BlockMotion& second, const ContactPoints& points);
  // Then takes them over, if there are any. Touches nothing but its own pair.
  void take(const Pair& pair, const ContactPoints& points);
  // Whether looks will find nothing to do as long as both blocks are at home.
  [[nodiscard]] bool far(const Pair& pair) const;

 private:
  [[nodiscard]] bool may_bounce(const Pair& pair) const;
  [[nodiscard]] bool on_surfaces(const Pair& pair, const packing::Separation& at) const;
  [[nodiscard]] ContactPoints points_at(const Pair& pair, const packing::PlacedPiece& first, const packing::PlacedPiece& second,
                                        const packing::Separation& at, double range) const;
  [[nodiscard]] ContactPoints met_on_the_way(const Pair& pair, const packing::PlacedPiece& first,
                                             const packing::PlacedPiece& second);
  [[nodiscard]] bool passes_by(const Pair& pair, const ContactPoints& points) const;
  [[nodiscard]] double room_needed(const Pair& pair, const ContactPoint& at) const;
  void let_pass(const Pair& pair, ContactPoints& points) const;
  [[nodiscard]] double approach(const Pair& pair, const ContactPoint& at) const;
  void set_bounce(const Pair& pair, HeldPoint& point, const ContactPoint& at) const;
  void inherit_impulses(std::span<const HeldPoint> old, double near);
  void drop_contact();

  const ContactRanges& ranges_;
  HeldContacts& contacts_;
  bool only_surfaces_ = false;
  HeldContact* contact_ = nullptr;
  btTransform relative_;         // pose of the second in the first's frame when evaluated
  double moved_ = 0;             // since then, at most [m]
  double evaluated_reach_ = -1;  // negative: never evaluated
  packing::Separation separation_;
  btVector3 tangent_{0, 0, 0};  // as in HeldContact, kept while there is none
};

}  // namespace scree::rigid
