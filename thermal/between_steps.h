// Temperatures at times that a step passes: on the cubic through the ends of the last four steps.
//
// With t0 the end of the step, t1 its start, t2 and t3 the ends before it, and D the third divided difference of the
// temperatures at the four (C. de Boor, A Practical Guide to Splines, 2001, chapter I), the parabola through the first three is
// off by
//   D (t - t0)(t - t1)(t - t2),
// which is taken for the error of the cubic, too. Ends of steps serve where rates would not: in the modes of stiff joints a
// rate is what is left of an error, times thousands a second.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace scree::thermal {

struct StepEnd {
  double time = 0;                                     // [s]
  std::shared_ptr<const Eigen::VectorXd> temperature;  // one per row of the model [K]
};
using StepEnds = std::vector<StepEnd>;  // the latest first

// The ends that are remembered with a later one: none without its temperatures.
StepEnds followed_by(const StepEnd& latest, const StepEnds& earlier);

class BetweenSteps {
 public:
  static constexpr std::size_t ends_before = 3;

  // A step that ended at this time with these temperatures; `before`: where it began and the ends before that, `ends_before` of
  // them at least. Refers to all of them.
  BetweenSteps(double time, const Eigen::VectorXd& temperature, const StepEnds& before);

  [[nodiscard]] Eigen::VectorXd at(double time) const;  // [K]

  // The largest of the parabola's errors at times between `first` and `last`, both `every` apart from others [K].
  [[nodiscard]] double error(double first, double last, double every) const;

 private:
  using Four = std::array<double, ends_before + 1>;
  template <class Factor>
  [[nodiscard]] Four products(const Factor& factor) const;
  [[nodiscard]] Eigen::VectorXd weighted(const Four& weights) const;

  Four times_;
  std::array<const Eigen::VectorXd*, ends_before + 1> temperatures_;
};

}  // namespace scree::thermal
