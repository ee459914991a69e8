// What was factorised before, and the number of threads, change no bit and no count.
#include "thermal/heat_solver.h"

#include <chrono>
#include <csignal>
#include <future>

#include <signal.h>

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
  // Step scales one after the other.
  Answers answers(const std::vector<double>& scales, int threads) const {
    const int before = threads_in_use();
    use_threads(threads);
    HeatSolver solver(model_, free_, LinearSolver::cholesky, SolverUse{});
    Answers result;
    for (const double scale : scales) {
      solver.prepare(linear_, scale);
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

TEST_F(HeatSolvers, GiveTheSameBitsOnHoweverManyThreadsAndWhateverWasSolvedBefore) {
  const std::vector<double> scales{1, 2, 4, 8, 4, 2, 1, 1000, 500, 1000, 1000, 1};
  const Answers alone = answers(scales, 1);
  const Answers together = answers(scales, 2);
  EXPECT_EQ(together.solutions, alone.solutions);
  EXPECT_EQ(together.estimates, alone.estimates);
  EXPECT_EQ(together.factorisations, alone.factorisations);
  EXPECT_EQ(alone.factorisations, 11);
  for (std::size_t i = 0; i < scales.size(); ++i) EXPECT_EQ(answers({scales[i]}, 1).solutions[0], alone.solutions[i]);
  EXPECT_NE(alone.solutions[0], alone.solutions[1]);
}

TEST_F(HeatSolvers, FactoriseNothingTwiceInARow) {
  EXPECT_EQ(answers({1, 2, 2, 2, 1, 1}, 1).factorisations, 3);
}

// METIS' own nested dissection would have a handler of its own meanwhile, and end the process with a signal that comes to
// another thread.
TEST(SignalWhileOrdering, GoesToWhomItWentBefore) {
  using Handler = void (*)(int);
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 30, 30, 1)});
  const HeatModel model = make_heat_model<3>(mesh, test::rock_only(), {}, test::options_for(mesh, 300));
  const SparseMatrix lower = FreeNodes(model).lower_block(model.conductance);
  const Handler ours = [](int) {};
  const Handler before = std::signal(SIGTERM, ours);
  const auto factor = make_cholesky();
  auto size = std::async(std::launch::async, [&] { return factor->analyse(lower); });
  int looks = 0, theirs = 0;
  for (; size.wait_for(std::chrono::microseconds(100)) == std::future_status::timeout; ++looks) {
    struct sigaction now = {};
    ::sigaction(SIGTERM, nullptr, &now);
    if (now.sa_handler != ours) ++theirs;
  }
  std::signal(SIGTERM, before);
  EXPECT_TRUE(size.get().possible);
  EXPECT_GT(looks, 100);
  EXPECT_EQ(theirs, 0);
}

}  // namespace
}  // namespace scree::thermal
