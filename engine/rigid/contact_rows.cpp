#include "engine/rigid/contact_rows.h"

#include <algorithm>
#include <limits>

namespace scree::rigid {

namespace {

using Bodies = std::array<BodyChange*, 2>;  // null: fixed

// Sums from the left, as Bullet does.
double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

Bodies bodies_of(const std::array<int, 2>& ids, std::vector<BodyChange>& bodies) {
  return {ids[0] < 0 ? nullptr : &bodies[ids[0]], ids[1] < 0 ? nullptr : &bodies[ids[1]]};
}

void solve(Row& row, const Bodies& bodies, double low, double high) {
  const auto& [first, second] = bodies;
  double impulse = row.wanted - row.applied * row.softness;
  if (first != nullptr) impulse -= (dot(row.direction, first->linear) + dot(row.moment[0], first->angular)) * row.scale;
  if (second != nullptr) impulse -= (-dot(row.direction, second->linear) + dot(row.moment[1], second->angular)) * row.scale;
  const double sum = row.applied + impulse;
  const double clamped = std::min(std::max(sum, low), high);
  if (clamped != sum) impulse = clamped - row.applied;
  row.applied = clamped;
  if (first != nullptr) {
    first->linear += (row.direction * first->inverse_mass) * impulse;
    first->angular += row.turn[0] * impulse;
  }
  if (second != nullptr) {
    second->linear -= (row.direction * second->inverse_mass) * impulse;
    second->angular += row.turn[1] * impulse;
  }
}

}  // namespace

void solve_contacts(std::vector<ContactRow>& rows, std::vector<BodyChange>& bodies) {
  for (ContactRow& row : rows) {
    const Bodies pair = bodies_of(row.bodies, bodies);
    solve(row.normal, pair, 0, std::numeric_limits<double>::infinity());
    if (row.normal.applied <= 0) continue;
    const double most = row.coefficient * row.normal.applied;
    for (Row& friction : row.friction) solve(friction, pair, -most, most);
  }
}

void solve_overlaps(std::vector<OverlapRow>& rows, std::vector<BodyChange>& bodies) {
  for (OverlapRow& row : rows) {
    solve(row.normal, bodies_of(row.bodies, bodies), 0, std::numeric_limits<double>::infinity());
  }
}

}  // namespace scree::rigid
