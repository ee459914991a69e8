// The contacts of a step as the solver's iterations go through them: what an iteration needs and nothing else, one after the
// other in memory. Bullet's own rows are twice as long, and most of an iteration is waiting for them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace scree::rigid {

// A body's change of velocity in this step, or the one that only undoes overlaps. One line of memory.
struct alignas(64) BodyChange {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // [m/s]
  double inverse_mass = 0;                            // [1/kg]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // [1/s]
  double unused = 0;
};

// One impulse along one direction between two bodies: the second gets its reverse.
struct Row {
  Eigen::Vector3d direction;
  std::array<Eigen::Vector3d, 2> moment;  // of the direction about the bodies' centres; minus that of the second
  std::array<Eigen::Vector3d, 2> turn;    // change of angular velocity by a unit impulse
  double wanted = 0;                      // change of the approach times `scale`, impulse units
  double scale = 0;                       // impulse per change of approach
  double applied = 0;
};

// Seven lines of memory; whom it concerns is asked first.
struct alignas(64) ContactRow {
  std::array<int, 2> bodies{-1, -1};  // -1: fixed
  double coefficient = 0;
  Row normal;
  std::array<Row, 2> friction;
};

struct OverlapRow {
  Row normal;
  std::array<int, 2> bodies{-1, -1};
};

// Gives the bodies the impulses that the rows start from.
void apply_impulses(std::span<const ContactRow> rows, std::vector<BodyChange>& bodies);

// One pass over all contacts: normal impulse, then friction within what it allows (sequential impulses).
void solve_contacts(std::span<ContactRow> rows, std::vector<BodyChange>& bodies);
// The same with normal impulses of `least` at least, one for each row.
void solve_contacts(std::span<ContactRow> rows, std::span<const double> least, std::vector<BodyChange>& bodies);
void solve_overlaps(std::span<OverlapRow> rows, std::vector<BodyChange>& bodies);

}  // namespace scree::rigid
