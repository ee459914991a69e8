#include "thermal/rkl2.h"

#include <gtest/gtest.h>

namespace scree::thermal::rkl2 {
namespace {

// Stages whose squares no int holds are among them: joints of a beta of 1e8 ask for as many.
TEST(Rkl2, AStepOfAnyNumberOfStagesReachesItsEnd) {
  for (const int stages : {3, 5, 101, 46'341, 100'001, 3'000'001}) {
    EXPECT_DOUBLE_EQ(part_at(stages, stages), 1) << stages;
    EXPECT_GT(first_coefficient(stages), 0) << stages;
    const Coefficients last = coefficients(stages, stages);
    EXPECT_NEAR(last.mu + last.nu, 1, 0.5) << stages;
    EXPECT_GT(last.product, 0) << stages;
    EXPECT_NEAR(estimate_of(stages), stages == 3 ? -0.6 : -0.4, 0.3) << stages;
  }
}

TEST(Rkl2, StagesAreTheFewestOddOnesThatAreStable) {
  for (const double ratio : {0.5, 2.5, 10.0, 1e6, 1e10, 1e14}) {
    const int stages = stages_for(ratio, 1);
    const auto stable = [](int s) { return (static_cast<double>(s) * s + s - 2) / 4; };
    EXPECT_EQ(stages % 2, 1) << ratio;
    EXPECT_GE(stable(stages), ratio * (1 - 1e-12)) << ratio;
    EXPECT_TRUE(stages == least_stages || stable(stages - 2) < ratio) << ratio;
  }
  EXPECT_EQ(stages_for(1e300, 1), most_stages);
}

}  // namespace
}  // namespace scree::thermal::rkl2
