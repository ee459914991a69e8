#include "engine/rigid/contact_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/base/quad.h"
#include "engine/rigid/fetch.h"

namespace scree::rigid {

namespace {

// A vector of three numbers and whatever follows them in memory, which is carried along and never looked at.
SCREE_INLINE Quad three(const Eigen::Vector3d& vector) {
  Quad numbers;
  load(numbers, vector.data());
  return numbers;
}

// Sums of the first three numbers of each.
SCREE_INLINE Quad sums_of_three(const Quad& p, const Quad& q, const Quad& r, const Quad& s) {
  const Quad even_pq = __builtin_shufflevector(p, q, 0, 4, 2, 6), odd_pq = __builtin_shufflevector(p, q, 1, 5, 3, 7);
  const Quad even_rs = __builtin_shufflevector(r, s, 0, 4, 2, 6), odd_rs = __builtin_shufflevector(r, s, 1, 5, 3, 7);
  const Quad first = __builtin_shufflevector(even_pq, even_rs, 0, 1, 4, 5);
  const Quad second = __builtin_shufflevector(odd_pq, odd_rs, 0, 1, 4, 5);
  return first + second + __builtin_shufflevector(even_pq, even_rs, 2, 3, 6, 7);
}

// The two bodies of a contact while it is worked on.
struct Moving {
  std::array<BodyChange*, 2> bodies;
  std::array<Quad, 2> linear, angular;
  std::array<double, 2> inverse_mass;
};

// `fixed` stands for bodies that do not move, and stays as it is.
SCREE_INLINE Moving take(const std::array<int, 2>& ids, std::vector<BodyChange>& bodies, BodyChange& fixed) {
  Moving pair;
  for (int i = 0; i < 2; ++i) {
    BodyChange& body = ids[i] < 0 ? fixed : bodies[ids[i]];
    pair.bodies[i] = &body;
    pair.linear[i] = three(body.linear);
    pair.angular[i] = three(body.angular);
    pair.inverse_mass[i] = body.inverse_mass;
  }
  return pair;
}

SCREE_INLINE void put_back(const Moving& pair) {
  for (int i = 0; i < 2; ++i) {
    BodyChange& body = *pair.bodies[i];
    store(__builtin_shufflevector(pair.linear[i], three(body.linear), 0, 1, 2, 7), body.linear.data());
    store(__builtin_shufflevector(pair.angular[i], three(body.angular), 0, 1, 2, 7), body.angular.data());
  }
}

SCREE_INLINE void push(const Row& row, Moving& pair, double impulse) {
  const Quad direction = three(row.direction);
  pair.linear[0] += direction * (pair.inverse_mass[0] * impulse);
  pair.linear[1] -= direction * (pair.inverse_mass[1] * impulse);
  for (int i = 0; i < 2; ++i) pair.angular[i] += three(row.turn[i]) * impulse;
}

// The impulse that would give the row by itself what it wants.
SCREE_INLINE double asked(const Row& row, const Moving& pair) {
  const Quad direction = three(row.direction);
  const Quad parts = sums_of_three(direction * pair.linear[0], three(row.moment[0]) * pair.angular[0],
                                   three(row.moment[1]) * pair.angular[1], direction * pair.linear[1]);
  return row.applied + row.wanted - (parts[0] + parts[1] + (parts[2] - parts[3])) * row.scale;
}

SCREE_INLINE void set(Row& row, Moving& pair, double impulse) {
  push(row, pair, impulse - row.applied);
  row.applied = impulse;
}

SCREE_INLINE void press(Row& row, Moving& pair, double least = 0) {
  set(row, pair, std::max(asked(row, pair), least));
}

// Coulomb's cone: both directions together within `most`. Bodies that stick get what each direction asks for. Where they slip,
// both directions take a step of the same length per speed, so that the impulse ends up against the slip whatever its heading.
SCREE_INLINE void rub(std::array<Row, 2>& friction, Moving& pair, double most) {
  double first = asked(friction[0], pair);
  double second = asked(friction[1], pair);
  if (first * first + second * second > most * most) {
    const double step = std::min(friction[0].scale, friction[1].scale);
    first = friction[0].applied + (first - friction[0].applied) * (step / friction[0].scale);
    second = friction[1].applied + (second - friction[1].applied) * (step / friction[1].scale);
    const double size = std::sqrt(first * first + second * second);
    const double part = size > most ? most / size : 1;
    first *= part;
    second *= part;
  }
  set(friction[0], pair, first);
  set(friction[1], pair, second);
}

// The two rows that will be solved after the next two.
SCREE_INLINE void fetch_ahead(std::span<const ContactRow> rows, std::size_t next) {
  for (std::size_t i = next + 4; i < std::min(next + 6, rows.size()); ++i) {
    fetch(&rows[i], sizeof(ContactRow));
  }
}

// Fixed bodies do not move.
SCREE_INLINE bool share_a_body(const ContactRow& a, const ContactRow& b) {
  const auto same = [](int one, int other) { return one >= 0 && one == other; };
  return same(a.bodies[0], b.bodies[0]) || same(a.bodies[0], b.bodies[1]) || same(a.bodies[1], b.bodies[0]) ||
         same(a.bodies[1], b.bodies[1]);
}

// Whether its friction may be anything but zero: one whose normal impulse has just gone must give up its friction, too.
SCREE_INLINE bool solve_normal(ContactRow& row, Moving& pair, double least = 0) {
  const bool pressed = row.normal.applied > 0;
  press(row.normal, pair, least);
  return pressed || row.normal.applied > 0;
}

SCREE_INLINE void solve_one(ContactRow& row, std::vector<BodyChange>& bodies, BodyChange& fixed, double least = 0) {
  Moving pair = take(row.bodies, bodies, fixed);
  if (solve_normal(row, pair, least)) rub(row.friction, pair, row.coefficient * row.normal.applied);
  put_back(pair);
}

// Contacts without a common body at once: neither waits for the other, and the bits are those of one after the other.
SCREE_INLINE void solve_two(ContactRow& a, ContactRow& b, std::vector<BodyChange>& bodies, BodyChange& fixed) {
  Moving of_a = take(a.bodies, bodies, fixed), of_b = take(b.bodies, bodies, fixed);
  const bool rubs_a = solve_normal(a, of_a), rubs_b = solve_normal(b, of_b);
  if (rubs_a) rub(a.friction, of_a, a.coefficient * a.normal.applied);
  if (rubs_b) rub(b.friction, of_b, b.coefficient * b.normal.applied);
  put_back(of_a);
  put_back(of_b);
}

}  // namespace

SCREE_WIDE void apply_impulses(std::span<const ContactRow> rows, std::vector<BodyChange>& bodies) {
  BodyChange fixed;
  for (const ContactRow& row : rows) {
    Moving pair = take(row.bodies, bodies, fixed);
    push(row.normal, pair, row.normal.applied);
    for (const Row& friction : row.friction) push(friction, pair, friction.applied);
    put_back(pair);
  }
}

SCREE_WIDE void solve_contacts(std::span<ContactRow> rows, std::vector<BodyChange>& bodies) {
  BodyChange fixed;
  for (std::size_t i = 0; i < rows.size();) {
    fetch_ahead(rows, i);
    if (i + 1 < rows.size() && !share_a_body(rows[i], rows[i + 1])) {
      solve_two(rows[i], rows[i + 1], bodies, fixed);
      i += 2;
    } else {
      solve_one(rows[i], bodies, fixed);
      ++i;
    }
  }
}

SCREE_WIDE void solve_contacts(std::span<ContactRow> rows, std::span<const double> least, std::vector<BodyChange>& bodies) {
  BodyChange fixed;
  for (std::size_t i = 0; i < rows.size(); ++i) solve_one(rows[i], bodies, fixed, least[i]);
}

SCREE_WIDE void solve_overlaps(std::span<OverlapRow> rows, std::vector<BodyChange>& bodies) {
  BodyChange fixed;
  for (OverlapRow& row : rows) {
    Moving pair = take(row.bodies, bodies, fixed);
    press(row.normal, pair);
    put_back(pair);
  }
}

}  // namespace scree::rigid
