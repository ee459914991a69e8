// Where blocks touch, kept from step to step: what the next step starts from, and nothing that follows from it and from where
// the blocks are. Bullet's manifolds hold the same in four times the memory, and a step would go through it three times.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace scree::rigid {

struct HeldPoint {
  Eigen::Vector3d on_first = Eigen::Vector3d::Zero();   // in the first block's frame [m]
  Eigen::Vector3d on_second = Eigen::Vector3d::Zero();  // in the second's
  double distance = 0;                                  // as the last step began, negative if they overlap [m]
  double restitution = 0;                               // [-]
  std::array<double, 3> impulses{};  // of the last step, along the normal and the directions of friction [N s]
};

// Between two blocks, or two pieces of theirs.
struct alignas(64) HeldContact {
  std::array<int, 2> blocks{-1, -1};
  int count = 0;                                      // of the points
  int place = 0;                                      // among all contacts
  bool fresh = false;                                 // the distances are of where the blocks are now
  double friction = 0;                                // [-]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   // from the second to the first, in the first's frame
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();  // first direction of friction, likewise; the other is across both
  std::array<HeldPoint, 4> points;
};

// All contacts, in an order that follows from how they came and went alone.
class HeldContacts {
 public:
  HeldContact& add(const std::array<int, 2>& blocks);
  void remove(HeldContact& contact);
  [[nodiscard]] std::span<HeldContact* const> all() const { return all_; }

 private:
  using Chunk = std::array<HeldContact, 1024>;
  std::vector<std::unique_ptr<Chunk>> memory_;
  std::vector<HeldContact*> unused_;
  std::vector<HeldContact*> all_;
};

}  // namespace scree::rigid
