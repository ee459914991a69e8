// What is factorised ahead of its time, or kept beside, changes no bit and no count.
#include "thermal/heat_solver.h"

#include <optional>

#include <gtest/gtest.h>

#include "engine/base/threads.h"
#include "tests/thermal/builders.h"
#include "thermal/drive.h"

namespace scree::thermal {
namespace {

class HeatSolvers : public testing::Test {
 protected:
  static HeatModel cube() {
    test::Slab<3> slab;
    slab.size.setConstant(0.1);
    slab.cells.fill(8);
    const auto mesh = test::slab_mesh<3>({slab});
    return make_heat_model<3>(mesh, test::rock_only(), {}, test::options_for(mesh, 300));
  }

  struct Answers {
    std::vector<Eigen::MatrixXd> solutions, estimates;
    std::int64_t factorisations = 0;
  };
  // Step scales one after the other, each with twice as much expected next, or nothing.
  Answers answers(const std::vector<double>& scales, int threads, bool expect_more) const {
    const int before = threads_in_use();
    use_threads(threads);
    HeatSolver solver(model_, free_, LinearSolver::cholesky, SolverUse{});
    Answers result;
    for (const double scale : scales) {
      solver.prepare(linear_, scale, expect_more ? std::optional(2 * scale) : std::nullopt);
      result.solutions.push_back(solver.solve(rhs_));
      result.estimates.push_back(solver.estimate(rhs_));
    }
    result.factorisations = solver.factorisations();
    use_threads(before);
    return result;
  }

  HeatModel model_ = cube();
  FreeNodes free_{model_};
  Drives drives_{model_};
  Linearised linear_ = HeatBalance(model_).linearised(model_.initial, drives_.at(0));
  Eigen::MatrixXd rhs_ = Eigen::VectorXd::LinSpaced(free_.size(), -1, 1);
};

TEST_F(HeatSolvers, GiveTheSameBitsAndCountsWhateverWasExpectedOnHoweverManyThreads) {
  // Growing as expected, falling back to the one before, a jump to what nobody expected, the same again.
  const std::vector<double> scales{1, 2, 4, 8, 4, 2, 1, 1000, 500, 1000, 1000, 1};
  const Answers alone = answers(scales, 1, false);
  for (const int threads : {1, 2}) {
    const Answers ahead = answers(scales, threads, true);
    EXPECT_EQ(ahead.solutions, alone.solutions) << threads << " threads";
    EXPECT_EQ(ahead.estimates, alone.estimates) << threads << " threads";
    EXPECT_EQ(ahead.factorisations, alone.factorisations) << threads << " threads";
  }
  EXPECT_EQ(alone.factorisations, 11);
  EXPECT_NE(alone.solutions[0], alone.solutions[1]);
}

}  // namespace
}  // namespace scree::thermal
