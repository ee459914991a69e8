// Sequential impulses between rigid bodies, starting from the impulses of the last step, friction included: the solver of
// Bullet 3.24 starts every step with no friction, and a pile creeps and sinks for want of it (README.md).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <span>
#include <vector>

#include "engine/rigid/contact_rows.h"
#include "engine/rigid/held_contacts.h"
#include "engine/rigid/row_batches.h"
#include "engine/rigid/row_setup.h"
#include "engine/rigid/sleepers.h"

class btRigidBody;

namespace scree::rigid {

class ContactSolver {
 public:
  using Contacts = std::span<HeldContact* const>;
  using Motions = std::span<const BlockMotion>;

  // A pair of blocks that touch.
  struct Touch {
    std::array<int, 2> blocks{-1, -1};
    double impulse = 0;  // of the last step, magnitude [N s]
    double depth = 0;    // of the deepest overlap as the step began, 0 if there is none [m]
    const HeldContact* of = nullptr;
  };

  // Gives the bodies the velocities by which the step moves them and the points their impulses, and takes overlaps apart; other
  // blocks are fixed, and so are those that sleep. The same bits for any number of threads. `motions` are those of all blocks;
  // the bodies' user indices are their blocks.
  void solve(const std::vector<btRigidBody*>& bodies, const Sleepers& sleepers, Motions motions, Contacts contacts,
             const StepLengths& step, int iterations);

  // Angular, of a body by its place among the bodies, after the last step [kg m2/s].
  [[nodiscard]] const Eigen::Vector3d& momentum(std::size_t body) const { return starts_[body].momentum; }

  // Of the last step, one per contact.
  [[nodiscard]] std::span<const Touch> touches() const { return touches_; }

 private:
  struct Entry {
    std::array<int, 2> ids;  // of its bodies
    int count = 0;           // of points; 0: nothing to solve
    int batch = 0;
    std::array<int, 4> rows;  // of its points
  };
  void start(const std::vector<btRigidBody*>& bodies, const Sleepers& sleepers, std::size_t blocks, double time_step);
  // Whether any of them, by their places among the bodies, does; -1: fixed.
  [[nodiscard]] bool moves(const std::array<int, 2>& ids) const {
    return std::any_of(ids.begin(), ids.end(), [&](int id) { return id >= 0 && starts_[id].inverse_mass > 0; });
  }
  void sort(Contacts contacts);
  bool order_rows(int slabs);
  void set_up(Motions motions, Contacts contacts, const StepLengths& step);
  void solve_rows(int iterations);
  void iterate(int iterations);
  // By what the rows give them.
  [[nodiscard]] bool bodies_gain_energy(const std::vector<btRigidBody*>& bodies) const;
  void solve_by_impulses(int iterations);
  Batches gather_overlaps();
  void undo_overlaps(const std::vector<btRigidBody*>& bodies, const StepLengths& step, int iterations);
  void finish(const std::vector<btRigidBody*>& bodies, Contacts contacts);

  // Kept from step to step for their memory.
  std::vector<int> places_;  // of each block's body among the bodies; -1: fixed
  std::vector<BodyStart> starts_;
  std::vector<BodyChange> changes_;
  std::vector<Entry> entries_;    // one per contact
  std::vector<Touch> touches_;    // likewise
  std::vector<ContactRow> rows_;  // by batches
  std::vector<double> overlaps_;  // one per row, see overlap_impulse
  std::vector<double> rebounds_;  // likewise, what of the row's wish is its rebound
  std::atomic<bool> any_rebound_ = false;
  std::vector<OverlapRow> overlap_rows_;  // by batches, those of points that overlap
  Batches batches_;
};

}  // namespace scree::rigid
