// The stabilised explicit scheme: RKL2, the Runge-Kutta-Legendre scheme of second order (Meyer, Balsara and Aslam, J. Comput.
// Phys. 257, 2014, eqs. 15 to 17). s products with K carry a step up to (s^2 + s - 2)/4 times as far as the stable one of eq.
// (8): where joints are no stiffer than blocks, that is less work than a factorisation.
//
// In increments D_j = Y_j - T0 at the times t0 + c_j h, with L = C^-1 J, J = -dF/dT and g(c) what the drive has become more
// by than at t0 [W]:
//   D_j = mu D_j-1 + nu D_j-2 - mu~ h C^-1 (J D_j-1 - g(c_j-1)) + (mu~ + gamma~) h C^-1 F(T0, t0),
//   D_1 = mu~_1 h C^-1 F(T0, t0).
// The step is also h C^-1 F of the stages' weighted mean, whose difference to T0 obeys S_j = mu S_j-1 + nu S_j-2 + mu~ D_j-1:
// that is what the ledger is given.
//
// What drives a step is taken for the parabola through its values at the start, the middle and the end (moving_drive.h), so a
// step sums it by the quadrature w = (2 q - 1/2, 2 - 4 q, 2 q - 1/2), q = sum_i b_i c_i^2 with b the mean's weights.
//
// Local error. The polynomial's third coefficient is c = (N - 6)/(9 (N - 2)), N = s^2 + s, so a step leaves out (1/6 - c) h^3
// T''', while H = (T0 - T1) + h/2 (T0' + T1') is (1/4 - c) h^3 T''': the estimate is their quotient times -H. Over the negative
// axis it is never below a mode's true error, and far above it for modes that are faster than the step (Sommeijer, Shampine and
// Verwer, J. Comput. Appl. Math. 88, 1997, use the like for RKC). What is left of the drive when the estimate is taken off is
// summed by Simpson's rule, up to b_1 c_1^2: 2 % of it in three stages, 0.2 % in five.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree::thermal::rkl2 {

inline constexpr int least_stages = 3;
inline constexpr int most_stages = 1'000'000'001;  // odd, too; no step takes as many

// j^2 + j - 2, of numbers whose squares no int holds.
inline double extent(int j) {
  return static_cast<double>(j) * j + j - 2.0;
}

inline int stages_for(double length, double stable) {
  if (std::isinf(stable)) return least_stages;
  const double ratio = length / stable;  // extent(s)/4
  const double stages = std::ceil(0.5 * (std::sqrt(9 + 16 * ratio) - 1));
  if (!(stages < most_stages)) return most_stages;
  return std::max(least_stages, static_cast<int>(stages) | 1);  // an odd number damps the fastest modes
}

struct Coefficients {
  double mu, nu, product, start;  // of D_j-1, D_j-2, -h L D_j-1 and h C^-1 F(T0)
};

// Of stage j >= 2 of s.
inline Coefficients coefficients(int j, int stages) {
  const auto b = [](int i) { return i < 2 ? 1.0 / 3 : extent(i) / (2.0 * i * (i + 1.0)); };
  const double w1 = 4.0 / extent(stages);
  const double mu = (2.0 * j - 1) / j * b(j) / b(j - 1);
  const double nu = -(j - 1.0) / j * b(j) / b(j - 2);
  const double product = mu * w1;
  return {mu, nu, product, product - (1 - b(j - 1)) * product};
}

inline double first_coefficient(int stages) {
  return 4.0 / (3 * extent(stages));
}

// When stage j >= 1 of s is, as a part of the step: c_j.
inline double part_at(int j, int stages) {
  return j < 2 ? first_coefficient(stages) : extent(j) / extent(stages);
}

// Of the drive at a step's start, middle and end.
struct DriveWeights {
  double start, middle, end;
};

inline DriveWeights drive_weights(int stages) {
  double older = 0;  // q of the stages so far, by the recursion of S
  double newer = 0;
  for (int j = 2; j <= stages; ++j) {
    const Coefficients with = coefficients(j, stages);
    const double part = part_at(j - 1, stages);
    older = with.mu * newer + with.nu * older + with.product * part * part;
    std::swap(older, newer);
  }
  return {2 * newer - 0.5, 2 - 4 * newer, 2 * newer - 0.5};
}

// What takes h^3 T''' of H to that of the step.
inline double estimate_of(int stages) {
  const double n = extent(stages) + 2;
  const double third = (n - 6) / (9 * (n - 2));
  return (third - 1.0 / 6) / (0.25 - third);
}

}  // namespace scree::thermal::rkl2
