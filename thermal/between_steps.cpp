#include "thermal/between_steps.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"

namespace scree::thermal {

StepEnds followed_by(const StepEnd& latest, const StepEnds& earlier) {
  if (!latest.temperature) return {};
  StepEnds ends{latest};
  ends.insert(ends.end(), earlier.begin(), earlier.end());
  ends.resize(std::min(ends.size(), BetweenSteps::ends_before));
  return ends;
}

BetweenSteps::BetweenSteps(double time, const Eigen::VectorXd& temperature, const StepEnds& before)
    : times_{time}, temperatures_{&temperature} {
  SCREE_EXPECT(before.size() >= ends_before);
  for (std::size_t i = 0; i < ends_before; ++i) {
    times_[i + 1] = before[i].time;
    temperatures_[i + 1] = before[i].temperature.get();
  }
}

// Of each end, the product of factor(its time, time of another) over the three others.
template <class Factor>
BetweenSteps::Four BetweenSteps::products(const Factor& factor) const {
  Four products;
  for (std::size_t i = 0; i < products.size(); ++i) {
    products[i] = 1;
    for (std::size_t j = 0; j < products.size(); ++j) {
      if (j != i) products[i] *= factor(times_[i], times_[j]);
    }
  }
  return products;
}

// Lagrange's form.
Eigen::VectorXd BetweenSteps::at(double time) const {
  return weighted(products([&](double own, double other) { return (time - other) / (own - other); }));
}

double BetweenSteps::error(double first, double last, double every) const {
  const Four of_difference = products([](double own, double other) { return 1 / (own - other); });
  double farthest = 0;
  for (double time = first; time <= last; time += every) {
    farthest = std::max(farthest, std::abs((time - times_[0]) * (time - times_[1]) * (time - times_[2])));
  }
  return farthest * weighted(of_difference).lpNorm<Eigen::Infinity>();
}

Eigen::VectorXd BetweenSteps::weighted(const Four& weights) const {
  return weights[0] * *temperatures_[0] + weights[1] * *temperatures_[1] + weights[2] * *temperatures_[2] +
         weights[3] * *temperatures_[3];
}

}  // namespace scree::thermal
