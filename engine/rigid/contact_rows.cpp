#include "engine/rigid/contact_rows.h"

#include <algorithm>
#include <cmath>

namespace scree::rigid {

namespace {

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

// The impulse that would give the row by itself what it wants.
[[gnu::always_inline]] inline double asked(const Row& row, const Bodies& bodies) {
  const auto& [first, second] = bodies;
  double change = 0;
  if (first != nullptr) change += row.direction.dot(first->linear) + row.moment[0].dot(first->angular);
  if (second != nullptr) change += row.moment[1].dot(second->angular) - row.direction.dot(second->linear);
  return row.applied + row.wanted - change * row.scale;
}

[[gnu::always_inline]] inline void set(Row& row, const Bodies& bodies, double impulse) {
  push(row, bodies, impulse - row.applied);
  row.applied = impulse;
}

[[gnu::always_inline]] inline void press(Row& row, const Bodies& bodies) {
  set(row, bodies, std::max(asked(row, bodies), 0.0));
}

// Coulomb's cone: both directions together within `most`. Bodies that stick get what each direction asks for. Where they slip,
// both directions take a step of the same length per speed, so that the impulse ends up against the slip whatever its heading.
[[gnu::always_inline]] inline void rub(std::array<Row, 2>& friction, const Bodies& bodies, double most) {
  double first = asked(friction[0], bodies);
  double second = asked(friction[1], bodies);
  if (first * first + second * second > most * most) {
    const double step = std::min(friction[0].scale, friction[1].scale);
    first = friction[0].applied + (first - friction[0].applied) * (step / friction[0].scale);
    second = friction[1].applied + (second - friction[1].applied) * (step / friction[1].scale);
    const double size = std::sqrt(first * first + second * second);
    const double part = size > most ? most / size : 1;
    first *= part;
    second *= part;
  }
  set(friction[0], bodies, first);
  set(friction[1], bodies, second);
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

// Whether its friction may be anything but zero: one whose normal impulse has just gone must give up its friction, too.
[[gnu::always_inline]] inline bool solve_normal(ContactRow& row, const Bodies& pair) {
  const bool pressed = row.normal.applied > 0;
  press(row.normal, pair);
  return pressed || row.normal.applied > 0;
}

void solve_one(ContactRow& row, std::vector<BodyChange>& bodies) {
  const Bodies pair = bodies_of(row.bodies, bodies);
  if (solve_normal(row, pair)) rub(row.friction, pair, row.coefficient * row.normal.applied);
}

// Contacts without a common body at once: neither waits for the other, and the bits are those of one after the other.
void solve_two(ContactRow& a, ContactRow& b, std::vector<BodyChange>& bodies) {
  const Bodies of_a = bodies_of(a.bodies, bodies), of_b = bodies_of(b.bodies, bodies);
  const bool rubs_a = solve_normal(a, of_a), rubs_b = solve_normal(b, of_b);
  if (rubs_a) rub(a.friction, of_a, a.coefficient * a.normal.applied);
  if (rubs_b) rub(b.friction, of_b, b.coefficient * b.normal.applied);
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
  for (OverlapRow& row : rows) press(row.normal, bodies_of(row.bodies, bodies));
}

}  // namespace scree::rigid
