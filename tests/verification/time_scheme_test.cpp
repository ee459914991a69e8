// Steps of both schemes against the exponential of the small system they solve.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/stable_step.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {
namespace {

// C dT/dt = -K T without boundaries, solved by the modes of C^-1/2 K C^-1/2.
class Modes {
 public:
  explicit Modes(const HeatModel& model) : root_(model.capacity.cwiseSqrt()) {
    const Eigen::VectorXd inverse = root_.cwiseInverse();
    const Eigen::MatrixXd scaled = inverse.asDiagonal() * Eigen::MatrixXd(model.conductance) * inverse.asDiagonal();
    modes_.compute(scaled);
  }

  [[nodiscard]] Eigen::VectorXd after(double time, const Eigen::VectorXd& start) const {
    const Eigen::VectorXd decay = (-time * modes_.eigenvalues().array()).exp();
    const Eigen::MatrixXd& vectors = modes_.eigenvectors();
    return root_.cwiseInverse().cwiseProduct(vectors * decay.cwiseProduct(vectors.transpose() * root_.cwiseProduct(start)));
  }

  [[nodiscard]] double slowest() const { return modes_.eigenvalues()[1]; }
  [[nodiscard]] double fastest() const { return modes_.eigenvalues().reverse()[0]; }

 private:
  Eigen::VectorXd root_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes_;
};

// Two halves of rubble, one warm.
HeatModel two_halves(double beta) {
  auto cold = test::bar<2>(0.04, 2, 2, 0.04);
  cold.block_per_element = true;
  auto warm = cold;
  warm.low[0] = 0.04;
  const auto mesh = test::slab_mesh<2>({cold, warm});
  HeatOptions options = test::options_for(mesh, 300);
  options.initial_temperature[BodyId{1}] = 400;
  options.joint.law = StiffnessFactor{beta};
  return make_heat_model(mesh, test::rock_only(), test::matching_contacts(mesh), options);
}

struct Steps {
  double error = 0;     // largest true error of any node after any step [K]
  double estimate = 0;  // the same, estimated [K]
  double last = 0;      // true error at the end [K]
};

Steps take(TimeScheme& scheme, const Modes& exact, const Eigen::VectorXd& start, double until, int count) {
  Eigen::VectorXd temperature = start;
  Eigen::VectorXd error = Eigen::VectorXd::Zero(start.size());
  Steps result;
  for (int n = 1; n <= count; ++n) {
    const Step step = scheme.step({(n - 1) * until / count, temperature, error}, until / count);
    temperature += step.change;
    error = step.error;
    result.last = (temperature - exact.after(n * until / count, start)).lpNorm<Eigen::Infinity>();
    result.error = std::max(result.error, result.last);
    result.estimate = std::max(result.estimate, error.lpNorm<Eigen::Infinity>());
  }
  return result;
}

TEST(TimeScheme, ImplicitAndStabilisedStepsAreOfSecondOrderAndExplicitOnesOfFirst) {
  const HeatModel model = two_halves(1);
  const Modes exact(model);
  const Eigen::VectorXd smooth = exact.after(0.3 / exact.slowest(), model.initial);
  const double until = 0.5 / exact.slowest();
  const auto implicit = make_implicit_scheme(model);
  const auto explicit_euler = make_explicit_scheme(model);
  const auto order = [&](TimeScheme& scheme, int count) {
    return std::log2(take(scheme, exact, smooth, until, count).last / take(scheme, exact, smooth, until, 2 * count).last);
  };
  EXPECT_NEAR(order(*implicit, 8), 2, 0.15);
  EXPECT_NEAR(order(*implicit, 32), 2, 0.05);
  const auto stabilised = make_stabilised_scheme(model);
  EXPECT_NEAR(order(*stabilised, 32), 2, 0.15);
  const int stable = static_cast<int>(std::ceil(until / stable_step(model).step));
  EXPECT_NEAR(order(*explicit_euler, stable), 1, 0.1);
}

// With the safety the scheme asks for, and for steps from far below to far above the fastest time scale of the joints.
TEST(TimeScheme, EstimateTimesSafetyBoundsTheErrorForAnyStep) {
  for (const double beta : {0.1, 10.0, 1e3}) {
    const HeatModel model = two_halves(beta);
    const Modes exact(model);
    const auto scheme = make_implicit_scheme(model);
    for (double step = 0.01 / exact.fastest(); step < 30 / exact.slowest(); step *= 2.7) {
      const Steps steps = take(*scheme, exact, model.initial, 20 * step, 20);
      EXPECT_LE(steps.error, scheme->safety() * steps.estimate) << beta << " " << step;
      EXPECT_GE(steps.error, 0.5 * steps.estimate) << beta << " " << step;
    }
    // Stabilised explicit ones: never below the true error; far above it for steps that leap over fast modes.
    const auto stabilised = make_stabilised_scheme(model);
    for (double step = 0.01 / exact.fastest(); step < 30 / exact.slowest(); step *= 2.7) {
      const Steps steps = take(*stabilised, exact, model.initial, 20 * step, 20);
      EXPECT_LE(steps.error, stabilised->safety() * steps.estimate) << beta << " " << step;
      if (step < 0.3 / exact.fastest()) {
        EXPECT_GE(steps.error, 0.5 * steps.estimate) << beta << " " << step;
      }
    }
  }
}

std::unique_ptr<TimeScheme> mixed_scheme(const HeatModel& model, double longest_short) {
  return make_mixed_scheme(make_stabilised_scheme(model), MadeMeanwhile(LongSteps{make_implicit_scheme(model), longest_short}));
}

// From far below the fastest time scale to the slowest, each length three times; the change from one scheme to the other
// anywhere among them.
TEST(TimeScheme, MixedStepsKeepTheEstimateAboveTheErrorWhereverTheyChangeOver) {
  for (const double beta : {1.0, 1e3}) {
    const HeatModel model = two_halves(beta);
    const Modes exact(model);
    const double first = 0.1 / exact.fastest();
    for (double longest_short = 0.3 / exact.fastest(); longest_short < 1 / exact.slowest(); longest_short *= 5) {
      const auto mixed = mixed_scheme(model, longest_short);
      Instant at{0, model.initial, Eigen::VectorXd::Zero(model.initial.size())};
      double error = 0, estimate = 0;
      for (double length = first; length < 1 / exact.slowest(); length *= 2) {
        for (int n = 0; n < 3; ++n) {
          const Step step = mixed->step(at, length);
          at = {at.time + length, at.temperature + step.change, step.error};
          error = std::max(error, (at.temperature - exact.after(at.time, model.initial)).lpNorm<Eigen::Infinity>());
          estimate = std::max(estimate, step.error.lpNorm<Eigen::Infinity>());
          EXPECT_LE(error, mixed->safety() * estimate) << beta << ' ' << longest_short << ' ' << length;
        }
      }
      EXPECT_GT(mixed->factorisations(), 0);
    }
  }
}

TEST(TimeScheme, MixedStepsAreThoseOfTheSchemeThatTheirLengthBelongsTo) {
  const HeatModel model = two_halves(1);
  const auto mixed = mixed_scheme(model, 2);
  const Instant start{0, model.initial, Eigen::VectorXd::Zero(model.initial.size())};
  EXPECT_EQ(mixed->step(start, 2).change, make_stabilised_scheme(model)->step(start, 2).change);
  EXPECT_EQ(mixed->step(start, 2.1).change, make_implicit_scheme(model)->step(start, 2.1).change);
  EXPECT_EQ(mixed->step(start, 1).change, make_stabilised_scheme(model)->step(start, 1).change);
}

// Whatever threads there are, long steps are made ready when or before one is asked for, and change no short one.
TEST(TimeScheme, MixedStepsDoNotWaitForTheLongOnesBeforeTheyNeedThem) {
  const int before = threads_in_use();
  const HeatModel model = two_halves(1);
  const Instant start{0, model.initial, Eigen::VectorXd::Zero(model.initial.size())};
  for (const int threads : {1, 2}) {
    use_threads(threads);
    std::promise<void> asked;
    bool made = false;
    const MadeMeanwhile<LongSteps> later([&, go_on = asked.get_future().share()] {
      go_on.wait();
      made = true;
      return LongSteps{make_implicit_scheme(model), 2};
    });
    const auto mixed = make_mixed_scheme(make_stabilised_scheme(model), later, 0.5);
    EXPECT_EQ(later.under_way(), threads > 1);
    EXPECT_EQ(mixed->step(start, 0.5).change, make_stabilised_scheme(model)->step(start, 0.5).change);
    EXPECT_EQ(mixed->factorisations(), 0);
    EXPECT_EQ(mixed->safety(), std::max(make_stabilised_scheme(model)->safety(), make_implicit_scheme(model)->safety()));
    EXPECT_FALSE(made);
    asked.set_value();
    EXPECT_EQ(mixed->step(start, 1).change, make_stabilised_scheme(model)->step(start, 1).change);
    EXPECT_TRUE(made);
    EXPECT_EQ(mixed->step(start, 2.1).change, make_implicit_scheme(model)->step(start, 2.1).change);
    EXPECT_GT(mixed->factorisations(), 0);
  }
  use_threads(before);
}

TEST(TimeScheme, AStepFarAboveAllTimeScalesEndsAtTheMeanWithoutRinging) {
  const HeatModel model = two_halves(1e3);
  const auto scheme = make_implicit_scheme(model);
  const double mean = model.capacity.dot(model.initial) / model.capacity.sum();
  const Step step = scheme->step({0, model.initial, Eigen::VectorXd::Zero(model.initial.size())}, 1e9);
  EXPECT_LT((model.initial + step.change).array().operator-(mean).abs().maxCoeff(), 0.01);
}

}  // namespace
}  // namespace scree::thermal
