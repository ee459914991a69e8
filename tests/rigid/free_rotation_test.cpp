// A body that nothing touches: Euler's equations.
#include "engine/rigid/free_rotation.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/rigid/bullet_pose.h"

namespace scree::rigid {
namespace {

const Eigen::Vector3d moments(1, 2.5, 3);  // [kg m2]

class Spinning {
 public:
  Spinning(double size, const Eigen::Vector3d& spin) : body_(1, nullptr, nullptr, to_bullet(size * moments)), size_(size) {
    body_.setAngularVelocity(to_bullet(spin));
  }

  void step(double time_step) {
    const FreeRotation rotation = free_rotation(body_, time_step);
    body_.proceedToTransform(moved(body_.getWorldTransform(), {0, 0, 0}, to_bullet(rotation.mean), time_step));
    body_.setAngularVelocity(body_.getInvInertiaTensorWorld() * to_bullet(rotation.momentum));
  }

  [[nodiscard]] Eigen::Vector3d spin() const { return from_bullet(body_.getAngularVelocity()); }
  // Of a body of size 1.
  [[nodiscard]] Eigen::Vector3d momentum() const { return momentum_of(body_, spin()) / size_; }
  [[nodiscard]] double energy() const { return 0.5 * momentum().dot(spin()); }
  [[nodiscard]] Eigen::Quaterniond orientation() const { return pose_of(body_.getWorldTransform()).rotation; }

 private:
  btRigidBody body_;
  double size_;
};

TEST(FreeRotation, KeepsMomentumAndEnergyOfGrainsAndOfRocks) {
  const Eigen::Vector3d spin(3, 20, 1);  // about the middle axis, about which no turn is stable
  std::vector<Eigen::Vector3d> ends;
  for (const double size : {1e-15, 1.0, 1e9}) {
    Spinning body(size, spin);
    const Eigen::Vector3d momentum = body.momentum();
    const double energy = body.energy();
    bool turned_over = false;
    for (int i = 0; i < 2400; ++i) {
      body.step(1.0 / 240);
      EXPECT_LT((body.momentum() - momentum).norm(), 1e-11 * momentum.norm());
      EXPECT_NEAR(body.energy(), energy, 1e-3 * energy);
      turned_over = turned_over || body.orientation().toRotationMatrix().col(1).dot(Eigen::Vector3d::UnitY()) < -0.5;
    }
    EXPECT_TRUE(turned_over);
    ends.push_back(body.spin());
  }
  EXPECT_LT((ends[0] - ends[1]).norm(), 1e-6);
  EXPECT_LT((ends[2] - ends[1]).norm(), 1e-6);
}

TEST(FreeRotation, IsOfSecondOrderInTheStep) {
  const auto after = [](int steps) {
    Spinning body(1, {5, 4, 3});
    for (int i = 0; i < steps; ++i) body.step(1.0 / steps);
    return body.orientation();
  };
  const Eigen::Quaterniond exact = after(20000);
  const double coarse = after(50).angularDistance(exact), fine = after(100).angularDistance(exact);
  EXPECT_LT(coarse, 0.02);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
}

TEST(FreeRotation, OfABodyWithEqualMomentsIsAConstantSpin) {
  btRigidBody body(1, nullptr, nullptr, btVector3(2, 2, 2));
  for (const Eigen::Vector3d& spin :
       {Eigen::Vector3d(1e-5, 0, 1e-6), Eigen::Vector3d(3, 4, 5), Eigen::Vector3d(300, 400, 900)}) {
    body.setAngularVelocity(to_bullet(spin));
    EXPECT_LT((free_rotation(body, 1.0 / 240).mean - spin).norm(), 1e-12 * spin.norm());
  }
}

TEST(Moved, TurnsByAnyAngle) {
  for (const double angle : {1e-9, 1e-3, 1.0, 3.0}) {
    const btTransform turned = moved(btTransform::getIdentity(), {0, 0, 0}, {0, 0, 240 * angle}, 1.0 / 240);
    EXPECT_NEAR(2 * std::asin(turned.getRotation().z()), angle, 1e-12 * (1 + angle)) << angle;
  }
}

}  // namespace
}  // namespace scree::rigid
