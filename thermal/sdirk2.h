// The implicit scheme: SDIRK of two stages, second order, L-stable (Alexander 1977; Hairer & Wanner 1996, section IV.6).
//
// For dH/dt = F(T, t), with gamma = 1 - 1/sqrt 2 and the step h,
//   H1 - H0 = gamma h F1,    H2 - H0 = (1 - gamma) h F1 + gamma h F2,    at t + gamma h and t + h,
// and the step ends at stage 2: the flows act with the weights 1 - gamma and gamma. Both stages solve with the same matrix
//   M = C + gamma h J,    C = dH/dT,  J = -dF/dT.
// For constant coefficients, with z = -h lambda and S = 1/(1 - gamma z), a step multiplies a mode by R = (1 + (1 - 2 gamma) z)
// S^2, as TR-BDF2 (Bank et al. 1985) does. But the first stage is an Euler step, which cannot overshoot; the trapezium's can go
// below 0 K after a sudden contact.
//
// Local error. With F0 at the step's start and f = C^-1 F, what the scheme adds to third order is, to leading order,
//   h sum_i delta_i f_i - missing h C^-1 J h (f2 - f1)/(1 - gamma),
// delta the scheme's weights less those of the quadrature at 0, gamma, 1 that is exact for parabolas, mu = missing/(gamma^2 (1
// - gamma)) with `missing` what J J f still lacks. Two solves damp it where h is long: with S = M^-1 C,
//   error = S (S (x + y) - y),    x = h sum_i delta_i f_i,   y = mu h (f2 - f1),   mu = missing/(gamma (1 - gamma)),
// as S gamma z = S - 1. On a mode of a constant operator it is kappa S (S - 1)^3, kappa = third_order/gamma^3, so the companion
// is R - kappa S (S - 1)^3, of third order and L-stable too: the estimate stays right for modes that are much faster than the
// step. Over the whole negative axis it is 0.73 to 1.14 times the true error of a step.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "thermal/drive_defect.h"

namespace scree::thermal::sdirk2 {

inline const double root2 = std::sqrt(2.0);
inline const double gamma = 1 - 1 / root2;
// (H2 - H0 without gamma h F2) over (H1 - H0).
inline const double from_first = (1 - gamma) / gamma;  // 1 + sqrt 2
// R - exp = third_order z^3 + ...
inline const double third_order = 3 * gamma * gamma - 2 * gamma * gamma * gamma - 1.0 / 6;
// Weights of the quadrature at 0, gamma and 1.
inline const double parabola1 = 1 / (6 * gamma * (1 - gamma));
inline const double parabola2 = 0.5 - gamma * parabola1;
inline const double delta0 = parabola1 + parabola2 - 1;
inline const double delta1 = 1 - gamma - parabola1;
inline const double delta2 = gamma - parabola2;
// sum_i delta_i a_ij c_j with the stages' coefficients a.
inline const double missing = third_order - (delta1 * gamma * gamma + delta2 * (2 * gamma - gamma * gamma));
inline const double mu = missing / (gamma * (1 - gamma));

inline std::vector<Look> drive_quadrature() {
  return {{0, 1 - parabola1 - parabola2}, {gamma, parabola1}, {1, parabola2}};
}

inline constexpr double safety = 1 / 0.73;  // of estimates: their least ratio to the true error of a step

// gamma h F at the step's start and at its two stages, of the free nodes [J].
struct StageHeats {
  Eigen::VectorXd start;
  Eigen::VectorXd first;
  Eigen::VectorXd last;
};

// The error of a step as above [K]; `solve` takes heat [J] through M.
template <class Solve>
Eigen::VectorXd local_error(const StageHeats& heats, const Eigen::VectorXd& capacity, const Solve& solve) {
  const Eigen::VectorXd x = (delta0 * heats.start + delta1 * heats.first + delta2 * heats.last) / gamma;
  const Eigen::VectorXd y = (heats.last - heats.first) * (mu / gamma);
  const Eigen::VectorXd damped = solve(x + y);
  return solve(capacity.cwiseProduct(damped) - y);
}

// The length of a step whose local error, third_order h^3 T''', is `allowed` [K]; infinite if nothing changes [s]. Linearised:
// `heating` flows into the free nodes [W], lost(change) is how much less does when their temperatures have changed [W].
template <class Lost>
double first_step(const Eigen::VectorXd& heating, const Eigen::VectorXd& capacity, const Lost& lost, double allowed) {
  Eigen::VectorXd derivative = heating.cwiseQuotient(capacity);
  for (int order = 2; order <= 3; ++order) derivative = -lost(derivative).cwiseQuotient(capacity);
  const double largest = derivative.lpNorm<Eigen::Infinity>();
  return largest > 0 ? std::cbrt(allowed / (third_order * largest)) : std::numeric_limits<double>::infinity();
}

}  // namespace scree::thermal::sdirk2
