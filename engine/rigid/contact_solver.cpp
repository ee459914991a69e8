#include "engine/rigid/contact_solver.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "engine/base/phases.h"
#include "engine/rigid/fetch.h"
#include "engine/rigid/free_rotation.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

// Bodies to a slab, and slabs at most.
constexpr int bodies_per_slab = 256;
constexpr int most_slabs = 64;

// Part of the rows that may lie across several slabs, for those are solved on one thread.
constexpr double rows_across = 0.05;

// The part of an overlap's turn that is undone with it, as in Bullet: more makes a block rock.
constexpr double overlap_turn = 0.1;

int slabs_for(std::size_t bodies) {
  int slabs = 1;
  while (slabs < most_slabs && static_cast<std::size_t>(2 * slabs) * bodies_per_slab <= bodies) slabs *= 2;
  return slabs;
}

ContactSolver::Touch touch_of(const HeldContact& contact) {
  ContactSolver::Touch touch{contact.blocks};
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  // along the axes of the contact, which all its points have
  for (const HeldPoint& point : std::span(contact.points).first(contact.count)) {
    impulse += Eigen::Map<const Eigen::Vector3d>(point.impulses.data());
    touch.depth = std::max(touch.depth, -point.distance);
  }
  touch.impulse = impulse.norm();
  touch.of = &contact;
  return touch;
}

// The contacts lie in no order.
void fetch_ahead(ContactSolver::Contacts contacts, std::size_t i, std::size_t bytes) {
  constexpr std::size_t ahead = 4;
  if (i + ahead < contacts.size()) fetch(contacts[i + ahead], bytes);
}

}  // namespace

void ContactSolver::solve(const std::vector<btRigidBody*>& bodies, const Sleepers& sleepers, Motions motions, Contacts contacts,
                          const StepLengths& step, int iterations) {
  start(bodies, sleepers, motions.size(), step.time_step);
  sort(contacts);
  set_up(motions, contacts, step);
  solve_rows(iterations);
  if (any_rebound_ && bodies_gain_energy(bodies)) solve_by_impulses(iterations);
  finish(bodies, contacts);
  undo_overlaps(bodies, step, iterations);
}

void ContactSolver::start(const std::vector<btRigidBody*>& bodies, const Sleepers& sleepers, std::size_t blocks,
                          double time_step) {
  places_.assign(blocks, -1);
  starts_.resize(bodies.size());
  changes_.assign(bodies.size(), {});
  for_short_chunks(bodies.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      places_[bodies[i]->getUserIndex()] = static_cast<int>(i);
      starts_[i] = sleepers.asleep(bodies[i]->getUserIndex()) ? start_asleep(*bodies[i]) : start_of(*bodies[i], time_step);
      changes_[i].inverse_mass = starts_[i].inverse_mass;
    }
  });
}

void ContactSolver::sort(Contacts contacts) {
  entries_.resize(contacts.size());
  for_short_chunks(entries_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      fetch_ahead(contacts, i, 64);
      Entry& entry = entries_[i];
      entry.ids = {places_[contacts[i]->blocks[0]], places_[contacts[i]->blocks[1]]};
      entry.count = moves(entry.ids) ? contacts[i]->count : 0;
    }
  });
  int slabs = slabs_for(starts_.size());
  while (!order_rows(slabs)) slabs /= 2;
}

// Within a batch the first points of all its pairs come first, then the second ones, and so on: what follows each other is of
// different bodies, and the processor need not wait for one to be done before it begins the next. False if too many are left
// for one thread.
bool ContactSolver::order_rows(int slabs) {
  std::vector<Eigen::Vector3d> centres;
  for (const BodyStart& start : starts_) centres.push_back(start.centre);
  const std::vector<int> slab = slabs_of(centres, slabs);
  std::vector<std::array<int, 4>> next(slabs + 1, {0, 0, 0, 0});
  for (Entry& entry : entries_) {
    const auto slab_of = [&](int body) { return body < 0 ? -1 : slab[body]; };
    if (entry.count > 0) entry.batch = batch_of(slab_of(entry.ids[0]), slab_of(entry.ids[1]), slabs);
    for (int k = 0; k < entry.count; ++k) ++next[entry.batch][k];
  }
  batches_.ends.assign(1, 0);
  int begin = 0;
  for (auto& rounds : next) {
    for (int& place : rounds) begin += std::exchange(place, begin);
    batches_.ends.push_back(begin);
  }
  if (slabs > 1 && begin - static_cast<int>(batches_.ends[slabs]) > rows_across * begin) return false;
  for (Entry& entry : entries_) {
    for (int k = 0; k < entry.count; ++k) entry.rows[k] = next[entry.batch][k]++;
  }
  return true;
}

void ContactSolver::set_up(Motions motions, Contacts contacts, const StepLengths& step) {
  rows_.resize(batches_.ends.back());
  overlaps_.resize(rows_.size());
  rebounds_.resize(rows_.size());
  any_rebound_ = false;
  for_short_chunks(entries_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      fetch_ahead(contacts, i, sizeof(HeldContact));
      const Entry& entry = entries_[i];
      if (entry.count == 0) continue;
      HeldContact& contact = *contacts[i];
      const PlacedContact placed = place(contact, motions[contact.blocks[0]].pose, motions[contact.blocks[1]].pose);
      const auto start_of_body = [&](int id) { return id < 0 ? nullptr : &starts_[id]; };
      const std::array<const BodyStart*, 2> bodies{start_of_body(entry.ids[0]), start_of_body(entry.ids[1])};
      for (int k = 0; k < entry.count; ++k) {
        ContactRow& row = rows_[entry.rows[k]];
        row.bodies = entry.ids;
        const double rebound = rebounds_[entry.rows[k]] = set_up_row(row, contact, placed, k, bodies, step);
        if (rebound > 0) any_rebound_.store(true, std::memory_order_relaxed);
        overlaps_[entry.rows[k]] = overlap_impulse(contact.points[k], row.normal, step);
      }
    }
  });
}

void ContactSolver::solve_rows(int iterations) {
  for_batches(batches_, 1, [&](std::size_t begin, std::size_t end) {
    apply_impulses(std::span(rows_).subspan(begin, end - begin), changes_);
  });
  iterate(iterations);
}

void ContactSolver::iterate(int iterations) {
  for_batches(batches_, iterations, [&](std::size_t begin, std::size_t end) {
    solve_contacts(std::span(rows_).subspan(begin, end - begin), changes_);
  });
}

// Summed in one order, whatever the number of threads.
bool ContactSolver::bodies_gain_energy(const std::vector<btRigidBody*>& bodies) const {
  constexpr double rounding = 1e-9;  // of the energy before
  double before = 0, gained = 0;     // twice the energies [J]
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!moves({static_cast<int>(i), -1})) continue;
    const BodyStart& start = starts_[i];
    const Eigen::Vector3d more = momentum_of(*bodies[i], changes_[i].angular);
    before += start.linear.squaredNorm() / start.inverse_mass;
    gained += changes_[i].linear.dot(2 * start.linear + changes_[i].linear) / start.inverse_mass +
              more.dot(2 * start.angular + changes_[i].angular);
  }
  return gained > rounding * before;
}

// Newton's restitution asks for speeds: what hits a body that cannot give way leaves it as fast as one that can, and where a
// body is hit from two sides at once that may be more energy than there was. Poisson's asks for impulses. The rows are solved
// without a rebound, and once more with that many times the impulses of those that have one: without friction no energy is
// gained, as the first are what takes the approaches away, the second no more than these, and the last solution takes away
// again.
void ContactSolver::solve_by_impulses(int iterations) {
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].normal.wanted -= rebounds_[i];
  iterate(iterations);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& normal = rows_[i].normal;
    rebounds_[i] = rebounds_[i] > 0 ? (1 + rebounds_[i] / normal.wanted) * normal.applied : 0;
  }
  for_batches(batches_, iterations, [&](std::size_t begin, std::size_t end) {
    const std::span<const double> least(rebounds_);
    solve_contacts(std::span(rows_).subspan(begin, end - begin), least.subspan(begin, end - begin), changes_);
  });
}

void ContactSolver::finish(const std::vector<btRigidBody*>& bodies, Contacts contacts) {
  for_short_chunks(bodies.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      if (!moves({static_cast<int>(i), -1})) continue;
      bodies[i]->setLinearVelocity(to_bullet(starts_[i].linear + changes_[i].linear));
      bodies[i]->setAngularVelocity(to_bullet(starts_[i].angular + changes_[i].angular));
      starts_[i].momentum += momentum_of(*bodies[i], changes_[i].angular);
    }
  });
  touches_.resize(entries_.size());
  for_short_chunks(entries_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      fetch_ahead(contacts, i, sizeof(HeldContact));
      HeldContact& contact = *contacts[i];
      if (!moves(entries_[i].ids) && touches_[i].of == &contact) continue;
      for (int k = 0; k < entries_[i].count; ++k) {
        const ContactRow& row = rows_[entries_[i].rows[k]];
        contact.points[k].impulses = {row.normal.applied, row.friction[0].applied, row.friction[1].applied};
      }
      touches_[i] = touch_of(contact);
    }
  });
}

// Into overlap_rows_; returns where its batches end.
Batches ContactSolver::gather_overlaps() {
  Batches batches{std::vector<std::size_t>(batches_.ends.size(), 0)};
  const auto for_each_batch = [&](const auto& use) {
    run_phases(std::array<int, 1>{batches_.count()}, 1, [&](int, int batch) { use(static_cast<std::size_t>(batch)); });
  };
  for_each_batch([&](std::size_t b) {
    for (std::size_t i = batches_.ends[b]; i < batches_.ends[b + 1]; ++i) batches.ends[b + 1] += overlaps_[i] > 0 ? 1 : 0;
  });
  std::partial_sum(batches.ends.begin(), batches.ends.end(), batches.ends.begin());
  overlap_rows_.resize(batches.ends.back());
  for_each_batch([&](std::size_t b) {
    std::size_t next = batches.ends[b];
    for (std::size_t i = batches_.ends[b]; i < batches_.ends[b + 1]; ++i) {
      if (overlaps_[i] <= 0) continue;
      OverlapRow& row = overlap_rows_[next++];
      row = {rows_[i].normal, rows_[i].bodies};
      row.normal.wanted = overlaps_[i];
      row.normal.applied = 0;
    }
  });
  return batches;
}

// Takes the overlaps apart without giving the bodies velocity.
void ContactSolver::undo_overlaps(const std::vector<btRigidBody*>& bodies, const StepLengths& step, int iterations) {
  const Batches batches = gather_overlaps();
  if (overlap_rows_.empty()) return;
  for_short_chunks(changes_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      changes_[i].linear = changes_[i].angular = Eigen::Vector3d::Zero();
    }
  });
  for_batches(batches, iterations, [&](std::size_t begin, std::size_t end) {
    solve_overlaps(std::span(overlap_rows_).subspan(begin, end - begin), changes_);
  });
  for_short_chunks(bodies.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      if (changes_[i].linear.isZero(0) && changes_[i].angular.isZero(0)) continue;
      bodies[i]->setWorldTransform(moved(bodies[i]->getWorldTransform(), to_bullet(changes_[i].linear),
                                         to_bullet(changes_[i].angular) * overlap_turn, step.time_step));
    }
  });
}

}  // namespace scree::rigid
