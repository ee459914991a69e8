#include "engine/rigid/contact_rows.h"

#include <algorithm>
#include <limits>

namespace scree::rigid {

namespace {

using Bodies = std::array<BodyChange*, 2>;  // null: fixed

Bodies bodies_of(const std::array<int, 2>& ids, std::vector<BodyChange>& bodies) {
  return {ids[0] < 0 ? nullptr : &bodies[ids[0]], ids[1] < 0 ? nullptr : &bodies[ids[1]]};
}

[[gnu::always_inline]] inline void push(const Row& row, const Bodies& bodies, double impulse) {
  const auto& [first, second] = bodies;
  if (first != nullptr) {
    first->linear += row.direction * (first->inverse_mass * impulse);
    first->angular += row.turn[0] * impulse;
  }
  if (second != nullptr) {
    second->linear -= row.direction * (second->inverse_mass * impulse);
    second->angular += row.turn[1] * impulse;
  }
}

[[gnu::always_inline]] inline void solve(Row& row, const Bodies& bodies, double low, double high) {
  const auto& [first, second] = bodies;
  double change = 0;
  if (first != nullptr) change += row.direction.dot(first->linear) + row.moment[0].dot(first->angular);
  if (second != nullptr) change += row.moment[1].dot(second->angular) - row.direction.dot(second->linear);
  const double sum = std::min(std::max(row.applied + row.wanted - change * row.scale, low), high);
  push(row, bodies, sum - row.applied);
  row.applied = sum;
}

}  // namespace

void apply_impulses(std::span<const ContactRow> rows, std::vector<BodyChange>& bodies) {
  for (const ContactRow& row : rows) {
    const Bodies pair = bodies_of(row.bodies, bodies);
    push(row.normal, pair, row.normal.applied);
    for (const Row& friction : row.friction) push(friction, pair, friction.applied);
  }
}

void solve_contacts(std::span<ContactRow> rows, std::vector<BodyChange>& bodies) {
  for (ContactRow& row : rows) {
    const Bodies pair = bodies_of(row.bodies, bodies);
    solve(row.normal, pair, 0, std::numeric_limits<double>::infinity());
    if (row.normal.applied <= 0) continue;
    const double most = row.coefficient * row.normal.applied;
    for (Row& friction : row.friction) solve(friction, pair, -most, most);
  }
}

void solve_overlaps(std::span<OverlapRow> rows, std::vector<BodyChange>& bodies) {
  for (OverlapRow& row : rows) {
    solve(row.normal, bodies_of(row.bodies, bodies), 0, std::numeric_limits<double>::infinity());
  }
}

}  // namespace scree::rigid
