// Two blocks at least one of which is no convex body but several convex pieces.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/rigid/polyhedron_collision.h"

namespace scree::rigid {

// Every two pieces that may touch in a step have a PolyhedronCollision of their own. Bullet's algorithm for compounds gives one
// up as soon as the two no longer overlap, and with it what the solver starts from: a block at rest then falls for a step
// whenever an overlap has been undone, and one that comes fast is first seen when it is deep inside.
class CompoundCollision final : public OwnCollision {
 public:
  CompoundCollision(const btCollisionAlgorithmConstructionInfo& info, const ContactRanges& ranges, HeldContacts& contacts)
      : OwnCollision(info), ranges_(ranges), contacts_(contacts) {}

  // As those of PolyhedronCollision, for all pieces: to be called one after the other, the second one pair at a time.
  void look(const BlockMotion& first, const BlockMotion& second, double time_step);
  void claim(const BlockMotion& first, const BlockMotion& second);
  void take(const BlockMotion& first, const BlockMotion& second, double time_step);

 private:
  struct Pieces {
    std::array<int, 2> numbers;  // of the two blocks' pieces
    std::unique_ptr<PolyhedronCollision> collision;
    std::optional<ContactPoints> news{};
  };
  void keep(const std::vector<std::array<int, 2>>& near);

  const ContactRanges& ranges_;
  HeldContacts& contacts_;
  std::vector<Pieces> pieces_;   // ascending
  std::vector<Pieces> dropped_;  // that are no longer near; they still hold their contacts
};

}  // namespace scree::rigid
