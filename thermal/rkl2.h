// The stabilised explicit scheme: RKL2, the Runge-Kutta-Legendre scheme of second order (Meyer, Balsara and Aslam, J. Comput.
// Phys. 257, 2014, eqs. 15 to 17). s products with K carry a step up to (s^2 + s - 2)/4 times as far as the stable one of eq.
// (8): where joints are no stiffer than blocks, that is less work than a factorisation.
//
// In increments D_j = Y_j - T0, for a drive that does not change and with L = C^-1 J, J = -dF/dT:
//   D_j = mu D_j-1 + nu D_j-2 - mu~ h L D_j-1 + (mu~ + gamma~) h C^-1 F(T0),   D_1 = mu~_1 h C^-1 F(T0).
// The step is also h C^-1 F of the stages' weighted mean, whose difference to T0 obeys S_j = mu S_j-1 + nu S_j-2 + mu~ D_j-1:
// that is what the ledger is given.
//
// Local error. The polynomial's third coefficient is c = (N - 6)/(9 (N - 2)), N = s^2 + s, so a step leaves out (1/6 - c) h^3
// T''', while H = (T0 - T1) + h/2 (T0' + T1') is (1/4 - c) h^3 T''': the estimate is their quotient times -H. Over the negative
// axis it is never below a mode's true error, and far above it for modes that are faster than the step (Sommeijer, Shampine and
// Verwer, J. Comput. Appl. Math. 88, 1997, use the like for RKC).
#pragma once

#include <algorithm>
#include <cmath>

namespace scree::thermal::rkl2 {

inline constexpr int least_stages = 3;

inline int stages_for(double length, double stable) {
  if (std::isinf(stable)) return least_stages;
  const double ratio = length / stable;  // (s^2 + s - 2)/4
  const int stages = static_cast<int>(std::ceil(0.5 * (std::sqrt(9 + 16 * ratio) - 1)));
  return std::max(least_stages, stages | 1);  // an odd number damps the fastest modes
}

struct Coefficients {
  double mu, nu, product, start;  // of D_j-1, D_j-2, -h L D_j-1 and h C^-1 F(T0)
};

// Of stage j >= 2 of s.
inline Coefficients coefficients(int j, int stages) {
  const auto b = [](int i) { return i < 2 ? 1.0 / 3 : (i * i + i - 2.0) / (2.0 * i * (i + 1)); };
  const double w1 = 4.0 / (stages * stages + stages - 2.0);
  const double mu = (2.0 * j - 1) / j * b(j) / b(j - 1);
  const double nu = -(j - 1.0) / j * b(j) / b(j - 2);
  const double product = mu * w1;
  return {mu, nu, product, product - (1 - b(j - 1)) * product};
}

inline double first_coefficient(int stages) {
  return 4.0 / (3 * (stages * stages + stages - 2.0));
}

// What takes h^3 T''' of H to that of the step.
inline double estimate_of(int stages) {
  const double n = stages * stages + stages;
  const double third = (n - 6) / (9 * (n - 2));
  return (third - 1.0 / 6) / (0.25 - third);
}

}  // namespace scree::thermal::rkl2
