#include "thermal/between_steps.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace scree::thermal {
namespace {

using Course = std::function<double(double)>;

Eigen::VectorXd two_nodes(const Course& course, double time) {
  return Eigen::Vector2d(300 + course(time), 300 - 2 * course(time));
}

// Steps that ended at 9, 7, 4 and 3 s.
class Steps {
 public:
  explicit Steps(const Course& course) : end_(two_nodes(course, 9)) {
    for (const double time : {7.0, 4.0, 3.0}) {
      before_.push_back({time, std::make_shared<Eigen::VectorXd>(two_nodes(course, time))});
    }
  }
  [[nodiscard]] BetweenSteps between() const { return {9, end_, before_}; }

 private:
  Eigen::VectorXd end_;
  StepEnds before_;
};

TEST(BetweenSteps, ACubicInTimeIsFoundExactly) {
  const Course cubic = [](double t) { return 5 - 2 * t + 0.3 * t * t - 0.04 * t * t * t; };
  const Steps steps(cubic);
  for (const double time : {7.0, 7.5, 8.0, 8.9, 9.0}) {
    EXPECT_LT((steps.between().at(time) - two_nodes(cubic, time)).lpNorm<Eigen::Infinity>(), 1e-11) << time;
  }
}

// Through 9, 7 and 4 s the parabola is off by 0.04 (t - 9)(t - 7)(t - 4).
TEST(BetweenSteps, TheErrorIsTheParabolas) {
  const Steps cubic([](double t) { return -0.04 * t * t * t; });
  EXPECT_NEAR(cubic.between().error(8, 8.5, 1), 2 * 0.04 * 1 * 1 * 4, 1e-9);
  EXPECT_NEAR(cubic.between().error(8.25, 8.9, 0.25), 2 * 0.04 * 0.75 * 1.25 * 4.25, 1e-9) << "the largest at those times";
  const Steps parabola([](double t) { return 3 * t * t - t; });
  EXPECT_LT(parabola.between().error(7.5, 8.5, 0.5), 1e-10);
}

TEST(BetweenSteps, OfADecayTheErrorIsMoreThanTheCubicIsOff) {
  for (const double rate : {0.03, 0.1, 0.3, 1.0}) {
    const Course decay = [&](double t) { return 50 * std::exp(-rate * t); };
    const Steps steps(decay);
    const double off = (steps.between().at(8) - two_nodes(decay, 8)).lpNorm<Eigen::Infinity>();
    EXPECT_GT(off, 0);
    EXPECT_LT(off, steps.between().error(8, 8.5, 1)) << rate;
  }
}

}  // namespace
}  // namespace scree::thermal
