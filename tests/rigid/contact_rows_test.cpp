// Impulses against the laws they must keep: Newton's third, Coulomb's, and a contact that does not pull.
#include "engine/rigid/contact_rows.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scree::rigid {
namespace {

using Eigen::Vector3d;

constexpr double mass_first = 2, mass_second = 3;

// A row through both centres, so that nothing turns: asks for the end of an approach [m/s].
Row central(const Vector3d& direction, double approach, double inverse_mass) {
  Row row;
  row.direction = direction;
  row.moment.fill(Vector3d::Zero());
  row.turn.fill(Vector3d::Zero());
  row.scale = 1 / inverse_mass;
  row.wanted = approach * row.scale;
  return row;
}

ContactRow contact(double approach, double slip, std::array<int, 2> bodies, double inverse_mass) {
  ContactRow row;
  row.normal = central({0, 0, 1}, approach, inverse_mass);
  row.friction = {central({1, 0, 0}, slip, inverse_mass), central({0, 1, 0}, 0, inverse_mass)};
  row.coefficient = 0.5;
  row.bodies = bodies;
  return row;
}

TEST(ContactRows, EndTheApproachOfTwoBodiesAndKeepTheirMomentum) {
  std::vector<BodyChange> bodies(2);
  bodies[0].inverse_mass = 1 / mass_first;
  bodies[1].inverse_mass = 1 / mass_second;
  std::vector<ContactRow> rows{contact(7, 0, {0, 1}, 1 / mass_first + 1 / mass_second)};
  solve_contacts(rows, bodies);
  EXPECT_NEAR(bodies[0].linear.z() - bodies[1].linear.z(), 7, 1e-14);
  EXPECT_NEAR((mass_first * bodies[0].linear + mass_second * bodies[1].linear).norm(), 0, 1e-14);
  EXPECT_NEAR(rows[0].normal.applied, 7 * mass_first * mass_second / (mass_first + mass_second), 1e-14);
}

TEST(ContactRows, LetFrictionStopASlowSlipAndOnlyBrakeAFastOne) {
  for (const double slip : {3.0, -3.0, 4.0, -40.0}) {
    std::vector<BodyChange> bodies(1);
    bodies[0].inverse_mass = 1 / mass_first;
    std::vector<ContactRow> rows{contact(7, slip, {0, -1}, 1 / mass_first)};
    solve_contacts(rows, bodies);
    const double most = 0.5 * 7;  // coefficient times the change along the normal
    EXPECT_NEAR(bodies[0].linear.x(), std::clamp(slip, -most, most), 1e-14) << slip;
  }
}

// Coulomb's cone: the size of the friction is that of its limit, and its heading against the slip.
TEST(ContactRows, BrakeASlipAgainstItsHeading) {
  for (const double angle : {0.1, 0.7, 2.0, 4.0}) {
    std::vector<BodyChange> bodies(1);
    bodies[0].inverse_mass = 1 / mass_first;
    const Vector3d slip = 40 * Vector3d(std::cos(angle), std::sin(angle), 0);
    std::vector<ContactRow> rows{contact(7, slip.x(), {0, -1}, 1 / mass_first)};
    rows[0].friction[1] = central({0, 1, 0}, slip.y(), 1 / mass_first);
    for (int pass = 0; pass < 3; ++pass) solve_contacts(rows, bodies);
    EXPECT_LT((bodies[0].linear - Vector3d(0, 0, 7) - 0.5 * 7 * slip.normalized()).norm(), 1e-13) << angle;
  }
}

TEST(ContactRows, DoNotPullBodiesThatPart) {
  std::vector<BodyChange> bodies(2);
  for (auto& body : bodies) body.inverse_mass = 1;
  std::vector<ContactRow> rows{contact(-2, 1, {0, 1}, 2)};
  solve_contacts(rows, bodies);
  EXPECT_EQ(rows[0].normal.applied, 0);
  for (const auto& body : bodies) EXPECT_EQ(body.linear.norm() + body.angular.norm(), 0);
}

// They start from the impulses of the last step, when they still pressed and rubbed. Alone, and two at once.
TEST(ContactRows, TakeTheFrictionOfBodiesThatPartAway) {
  for (const int count : {1, 2}) {
    std::vector<BodyChange> bodies(count);
    std::vector<ContactRow> rows;
    for (int i = 0; i < count; ++i) {
      bodies[i].inverse_mass = 1;
      rows.push_back(contact(-2, 1, {i, -1}, 1));
      rows[i].normal.applied = 5;
      rows[i].friction[0].applied = 2;
    }
    apply_impulses(rows, bodies);
    for (int pass = 0; pass < 2; ++pass) solve_contacts(rows, bodies);
    for (const ContactRow& row : rows) {
      EXPECT_EQ(row.normal.applied, 0);
      EXPECT_EQ(row.friction[0].applied, 0);
    }
    for (const BodyChange& body : bodies) EXPECT_LT(body.linear.norm(), 1e-15);
  }
}

TEST(ContactRows, OfAChainOfBodiesConvergeToTheMotionOfOne) {
  // A moving ball pushes a row of four at rest without rebound: all end with a fifth of its speed.
  constexpr int balls = 5;
  std::vector<BodyChange> bodies(balls);
  for (auto& body : bodies) body.inverse_mass = 1;
  std::vector<ContactRow> rows;
  for (int i = 0; i + 1 < balls; ++i) rows.push_back(contact(i == 0 ? 1 : 0, 0, {i + 1, i}, 2));
  for (int pass = 0; pass < 400; ++pass) solve_contacts(rows, bodies);
  EXPECT_NEAR(1 + bodies[0].linear.z(), 1.0 / balls, 1e-9);
  for (int i = 1; i < balls; ++i) EXPECT_NEAR(bodies[i].linear.z(), 1.0 / balls, 1e-9);
}

// One number after the other, as the rows are defined.
class OneByOne {
 public:
  OneByOne(const std::array<int, 2>& ids, std::vector<BodyChange>& bodies) {
    for (int i = 0; i < 2; ++i) bodies_[i] = ids[i] < 0 ? nullptr : &bodies[ids[i]];
  }

  [[nodiscard]] double asked(const Row& row) const {
    double change = 0;
    for (int i = 0; i < 2; ++i) {
      if (bodies_[i] == nullptr) continue;
      const double along = dot(row.direction, bodies_[i]->linear);
      change += dot(row.moment[i], bodies_[i]->angular) + (i == 0 ? along : -along);
    }
    return row.applied + row.wanted - change * row.scale;
  }

  void set(Row& row, double impulse) {
    const double more = impulse - row.applied;
    row.applied = impulse;
    for (int i = 0; i < 2; ++i) {
      if (bodies_[i] == nullptr) continue;
      const double push = (i == 0 ? 1 : -1) * (bodies_[i]->inverse_mass * more);
      for (int k = 0; k < 3; ++k) {
        bodies_[i]->linear[k] += row.direction[k] * push;
        bodies_[i]->angular[k] += row.turn[i][k] * more;
      }
    }
  }

 private:
  static double dot(const Vector3d& a, const Vector3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  std::array<BodyChange*, 2> bodies_;
};

// With friction that holds whatever presses.
void solve_one_by_one(std::vector<ContactRow>& rows, std::vector<BodyChange>& bodies) {
  for (ContactRow& row : rows) {
    OneByOne pair(row.bodies, bodies);
    pair.set(row.normal, std::max(pair.asked(row.normal), 0.0));
    const double holds = row.normal.applied > 0 ? 1 : 0;
    const std::array<double, 2> friction{holds * pair.asked(row.friction[0]), holds * pair.asked(row.friction[1])};
    for (int i = 0; i < 2; ++i) pair.set(row.friction[i], friction[i]);
  }
}

TEST(ContactRows, SolvedFourNumbersAtATimeGiveTheBitsOfOneByOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
  std::vector<BodyChange> bodies(12);
  for (BodyChange& body : bodies) body.inverse_mass = 1.5 + number(random);
  std::vector<ContactRow> rows(100);
  for (ContactRow& contact : rows) {
    const int first = static_cast<int>(random() % bodies.size());
    contact.bodies = {first, static_cast<int>((first + 1 + random() % (bodies.size() - 1)) % bodies.size())};
    const int fixed = static_cast<int>(random() % 6);
    if (fixed < 2) contact.bodies[fixed] = -1;
    contact.coefficient = 1e9;
    for (Row* row : {&contact.normal, &contact.friction[0], &contact.friction[1]}) {
      row->direction = vector();
      for (int i = 0; i < 2; ++i) {
        row->moment[i] = contact.bodies[i] < 0 ? Vector3d(0, 0, 0) : vector();
        row->turn[i] = contact.bodies[i] < 0 ? Vector3d(0, 0, 0) : vector();
      }
      row->scale = 0.1;
      row->wanted = 2 + number(random);
    }
  }
  auto expected_rows = rows;
  auto expected = bodies;
  for (int pass = 0; pass < 5; ++pass) {
    solve_contacts(rows, bodies);
    solve_one_by_one(expected_rows, expected);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    EXPECT_EQ(bodies[i].linear, expected[i].linear) << i;
    EXPECT_EQ(bodies[i].angular, expected[i].angular) << i;
    EXPECT_EQ(bodies[i].inverse_mass, expected[i].inverse_mass) << i;
    EXPECT_GT(bodies[i].linear.norm(), 0.01) << i;
  }
}

TEST(ContactRows, PushOverlapsApartByAsMuchAsTheyWant) {
  std::vector<BodyChange> bodies(1);
  bodies[0].inverse_mass = 1 / mass_first;
  std::vector<OverlapRow> rows{{central({0, 0, 1}, 0.25, 1 / mass_first), {-1, 0}}};
  for (int pass = 0; pass < 3; ++pass) solve_overlaps(rows, bodies);
  EXPECT_NEAR(bodies[0].linear.z(), -0.25, 1e-15);
}

}  // namespace
}  // namespace scree::rigid
