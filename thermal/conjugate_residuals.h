// Solves M x = b for any regular M by means of a matrix near it that can be solved for: generalised conjugate residuals
// (S. C. Eisenstat, H. C. Elman and M. H. Schultz, SIAM J. Numer. Anal. 20, 1983), preconditioned from the left.
//
// What is kept in hand is z = S^-1 (b - M x), about what x lacks, so accuracy is measured in x, however stiff M is, and the
// last z is added to the x that is returned. With S near M two solves with it do, where a library's iteration takes three: it
// has no use for the last z.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Core>

#include "engine/base/check.h"

namespace scree::thermal {

// multiply(x): M x. divide(b): about M^-1 b, linear in b. `accuracy`: of x by its norm, or as far as rounding lets it come.
// What is not finite stays so.
template <class Multiply, class Divide>
Eigen::VectorXd conjugate_residuals(const Multiply& multiply, const Divide& divide, const Eigen::VectorXd& b, double accuracy) {
  constexpr int most_iterations = 60;
  constexpr double rounding = 1e-6;  // of x: what gains little below it has come to its end
  constexpr double little_gain = 0.5;

  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  Eigen::VectorXd z = divide(b);
  double before = z.norm();
  if (!(before > 0)) return z;
  double missed = 0;                                // the largest part of a z that S^-1 M z did not give back
  std::vector<Eigen::VectorXd> directions, images;  // p, and S^-1 M p of unit length and at right angles to each other
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Eigen::VectorXd p = z;
    Eigen::VectorXd image = divide(multiply(p));
    missed = std::max(missed, (image - z).norm() / before);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double along = image.dot(images[i]);
      image -= along * images[i];
      p -= along * directions[i];
    }
    const double length = image.norm();
    const double share = z.dot(image) / (length * length);
    x += share * p;
    z -= share * image;
    const double left = z.norm(), all = x.norm();
    if (!std::isfinite(left)) return z;
    const bool at_its_end = left > little_gain * before && left <= rounding * all;
    if (missed * left <= accuracy * all || at_its_end) return x + z;
    directions.emplace_back(p / length);
    images.emplace_back(image / length);
    before = left;
  }
  throw RunError(
      fmt::format("The linear equations of a conductivity that depends on temperature were not solved to {:g} in {} "
                  "iterations: it changes too much across joints. Run it in time by heat.integrator: stabilised_explicit",
                  accuracy, most_iterations));
}

}  // namespace scree::thermal
