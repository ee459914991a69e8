#include "engine/rigid/contact_rows.h"

#include <algorithm>
#include <limits>

namespace scree::rigid {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr std::size_t line = 64;  // bytes that memory gives at once

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

// The two rows that will be solved after the next two.
void fetch_ahead(std::span<const ContactRow> rows, std::size_t next) {
  for (std::size_t i = next + 4; i < std::min(next + 6, rows.size()); ++i) {
    const char* row = reinterpret_cast<const char*>(&rows[i]);
    for (std::size_t at = 0; at < sizeof(ContactRow); at += line) __builtin_prefetch(row + at);
  }
}

// Fixed bodies do not move.
bool share_a_body(const ContactRow& a, const ContactRow& b) {
  const auto same = [](int one, int other) { return one >= 0 && one == other; };
  return same(a.bodies[0], b.bodies[0]) || same(a.bodies[0], b.bodies[1]) || same(a.bodies[1], b.bodies[0]) ||
         same(a.bodies[1], b.bodies[1]);
}

void solve_one(ContactRow& row, std::vector<BodyChange>& bodies) {
  const Bodies pair = bodies_of(row.bodies, bodies);
  solve(row.normal, pair, 0, unlimited);
  if (row.normal.applied <= 0) return;
  const double most = row.coefficient * row.normal.applied;
  for (Row& friction : row.friction) solve(friction, pair, -most, most);
}

// Contacts without a common body at once: neither waits for the other, and the bits are those of one after the other.
void solve_two(ContactRow& a, ContactRow& b, std::vector<BodyChange>& bodies) {
  const Bodies of_a = bodies_of(a.bodies, bodies), of_b = bodies_of(b.bodies, bodies);
  solve(a.normal, of_a, 0, unlimited);
  solve(b.normal, of_b, 0, unlimited);
  const bool rubs_a = a.normal.applied > 0, rubs_b = b.normal.applied > 0;
  const double most_a = a.coefficient * a.normal.applied, most_b = b.coefficient * b.normal.applied;
  for (std::size_t i = 0; i < a.friction.size(); ++i) {
    if (rubs_a) solve(a.friction[i], of_a, -most_a, most_a);
    if (rubs_b) solve(b.friction[i], of_b, -most_b, most_b);
  }
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
  for (std::size_t i = 0; i < rows.size();) {
    fetch_ahead(rows, i);
    if (i + 1 < rows.size() && !share_a_body(rows[i], rows[i + 1])) {
      solve_two(rows[i], rows[i + 1], bodies);
      i += 2;
    } else {
      solve_one(rows[i], bodies);
      ++i;
    }
  }
}

void solve_overlaps(std::span<OverlapRow> rows, std::vector<BodyChange>& bodies) {
  for (OverlapRow& row : rows) solve(row.normal, bodies_of(row.bodies, bodies), 0, unlimited);
}

}  // namespace scree::rigid
