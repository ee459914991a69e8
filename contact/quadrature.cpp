#include "contact/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace scree::contact {

// Gauss's rule.
Quadrature<2> quadrature(const Polygon<2>& segment) {
  const double middle = 0.5 * (segment[0][0] + segment[1][0]), half = 0.5 * (segment[1][0] - segment[0][0]);
  const double way = half / std::numbers::sqrt3;
  return {{{{middle - way}, {middle + way}}}, 2 * std::abs(half)};
}

// Any polygon has three such places about its mean: at the corners of an equilateral triangle on the circle of the radius root
// two, seen so that the variance is one all around (Stroud, Mathematics of Computation 14, 1960). That circle lies within every
// convex figure (Kannan, Lovasz and Simonovits, Discrete & Computational Geometry 13, 1995, theorem 4.1). It touches the sides
// of a triangle, so the first place is towards a corner: there they are (2/3, 1/6, 1/6).
Quadrature<3> quadrature(const Polygon<3>& polygon) {
  using Vector = Eigen::Vector2d;
  const auto way_to = [&](int i) { return Vector(polygon[i][0] - polygon[0][0], polygon[i][1] - polygon[0][1]); };
  double size = 0;
  Vector sum = Vector::Zero();                        // times 3
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();  // times 12
  for (int i = 2; i < polygon.size(); ++i) {
    const double piece = std::abs(spanned<3>(polygon[0], polygon[i - 1], polygon[i]));
    const Vector a = way_to(i - 1), b = way_to(i), both = a + b;
    size += piece;
    sum += piece * both;
    squares += piece * (a * a.transpose() + b * b.transpose() + both * both.transpose());
  }
  Quadrature<3> rule;
  rule.size = size;
  if (size == 0) return rule;
  const double each = 1 / size;
  const Vector mean = each / 3 * sum;
  const Eigen::Matrix2d variance = each / 12 * squares - mean * mean.transpose();
  // Its root: a lower triangle. Of what is as thin as rounding the second column may be nothing.
  const double along = std::sqrt(std::max(0.0, variance(0, 0)));
  const double skew = along > 0 ? variance(0, 1) / along : 0;
  const double across = std::sqrt(std::max(0.0, variance(1, 1) - skew * skew));
  Vector towards(1, 0);  // the first corner, as seen where the variance is one, times the determinant of the root
  if (along > 0 && across > 0) towards << -mean.x() * across, skew * mean.x() - along * mean.y();
  towards *= std::numbers::sqrt2 / towards.norm();
  const Vector aside = 0.5 * std::numbers::sqrt3 * Vector(-towards.y(), towards.x());
  const std::array<Vector, 3> corners = {towards, -0.5 * towards + aside, -0.5 * towards - aside};
  for (int i = 0; i < 3; ++i) {
    rule.places[i] = {polygon[0][0] + mean.x() + along * corners[i].x(),
                      polygon[0][1] + mean.y() + skew * corners[i].x() + across * corners[i].y()};
  }
  return rule;
}

}  // namespace scree::contact
