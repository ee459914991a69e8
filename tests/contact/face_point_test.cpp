#include "contact/face_point.h"

#include <random>

#include <gtest/gtest.h>

#include "contact/segment.h"

namespace scree::contact {
namespace {

// No point of a fine net over the face is closer, and one comes close: independent of how the weights were found.
TEST(ClosestWeights, OnATriangleAgreeWithAFineNetOfPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto draw = [&]() -> Point<3> { return {unit(random), unit(random), unit(random)}; };
  int inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Corners<3> corners{draw(), draw(), draw()};
    const Point<3> point = draw();
    const auto weights = closest_weights<3>(corners, point);
    inside += std::count(weights.begin(), weights.end(), 0.0) == 0;
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-9);
    const double distance = (weighted_point<3>(corners, weights) - point).norm();
    double least = 1e9;
    constexpr int net = 60;
    for (int i = 0; i <= net; ++i) {
      for (int j = 0; i + j <= net; ++j) {
        const std::array<double, 3> at{double(i) / net, double(j) / net, double(net - i - j) / net};
        least = std::min(least, (weighted_point<3>(corners, at) - point).norm());
      }
    }
    EXPECT_LE(distance, least + 1e-9);
    EXPECT_GE(distance, least - 2.0 * 2 / net);
  }
  EXPECT_GT(inside, 30);
  EXPECT_LT(inside, 270);
}

TEST(ClosestWeights, OnASegmentStopAtItsEnds) {
  const Corners<2> corners{Point<2>{0, 0}, Point<2>{2, 0}};
  EXPECT_EQ(closest_weights<2>(corners, {0.5, 3}), (std::array<double, 2>{0.75, 0.25}));
  EXPECT_EQ(closest_weights<2>(corners, {-1, 3}), (std::array<double, 2>{1, 0}));
  EXPECT_EQ(closest_weights<2>(corners, {9, 3}), (std::array<double, 2>{0, 1}));
}

TEST(LineCrossing, IsPerpendicularToBothLines) {
  const Point<3> a0{0, 0, 0}, a1{2, 0, 0}, b0{0.5, -1, 1}, b1{0.5, 3, 1};
  const auto crossing = line_crossing(a0, a1, b0, b1);
  ASSERT_TRUE(crossing.has_value());
  EXPECT_DOUBLE_EQ(crossing->along_a, 0.25);
  EXPECT_DOUBLE_EQ(crossing->along_b, 0.25);
  EXPECT_DOUBLE_EQ(std::abs(crossing->normal.z()), 1);
}

TEST(LineCrossing, OfParallelLinesIsNone) {
  EXPECT_FALSE(line_crossing({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1.01, 0}).has_value());
}

}  // namespace
}  // namespace scree::contact
