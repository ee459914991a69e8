#include "contact/overlap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree::contact {

namespace {

constexpr double least_share = 1e-13;  // of the smaller face

// A place in a plane (2-D: on a line).
template <int dim>
using Seen = std::array<double, dim - 1>;

template <int dim>
using SeenFace = std::array<Seen<dim>, dim>;

// How points are seen along a normal: carried along it into a plane of two axes (2-D: onto one). Weights on a face are the same
// as in the plane across the normal, areas larger.
template <int dim>
class Sight {
 public:
  Sight(const Point<dim>& normal, const Point<dim>& origin) : origin_(origin) {
    normal.cwiseAbs().maxCoeff(&depth_);
    for (int i = 0; i < dim; ++i) tilt_[i] = normal[i] / normal[depth_];
    shrink_ = std::abs(normal[depth_]);
  }

  // From the origin, so that rounding is that of a face and not of its distance from that of all coordinates.
  [[nodiscard]] SeenFace<dim> of(const Corners<dim>& corners) const {
    SeenFace<dim> face;
    for (int corner = 0; corner < dim; ++corner) {
      const Point<dim> way = corners[corner] - origin_;
      for (int i = 0; i < dim - 1; ++i) {
        const int axis = (depth_ + 1 + i) % dim;
        face[corner][i] = way[axis] - tilt_[axis] * way[depth_];
      }
    }
    return face;
  }

  // Across the normal, of what is seen as so large.
  [[nodiscard]] double area(double seen) const { return shrink_ * std::abs(seen); }

 private:
  Point<dim> origin_;
  Point<dim> tilt_;
  int depth_ = 0;  // the axis that is carried away
  double shrink_ = 1;
};

// The length (3-D: twice the area) that the ways from one place span, with its sign: exactly none from or to one place twice.
template <int dim>
double spanned(const Seen<dim>& from, const auto&... to) {
  const auto way = [&](const auto& end, std::size_t i) { return end[i] - from[i]; };
  if constexpr (dim == 2) {
    return (way(to, 0), ...);
  } else {
    const auto cross = [&](const auto& a, const auto& b) { return way(a, 0) * way(b, 1) - way(a, 1) * way(b, 0); };
    return cross(to...);
  }
}

// The weights of one face's corners at those of another, as seen. All are multiplied by `whole`, which has the sign of the
// first one's sense of rotation and is (3-D: twice) its area.
template <int dim>
struct WeightsAt {
  double whole = 0;
  std::array<std::array<double, dim>, dim> of;  // [corner of the one][corner of the other]
};

template <int dim>
WeightsAt<dim> weights_at(const SeenFace<dim>& face, const SeenFace<dim>& other) {
  WeightsAt<dim> weights;
  if constexpr (dim == 2) {
    weights.whole = spanned<2>(face[0], face[1]);
  } else {
    weights.whole = spanned<3>(face[0], face[1], face[2]);
  }
  for (int i = 0; i < dim; ++i) {
    for (int k = 0; k < dim; ++k) {
      if constexpr (dim == 2) {
        weights.of[i][k] = i == 0 ? spanned<2>(other[k], face[1]) : spanned<2>(face[0], other[k]);
      } else {
        weights.of[i][k] = spanned<3>(face[(i + 1) % 3], face[(i + 2) % 3], other[k]);
      }
    }
  }
  return weights;
}

// Does the other face lie beyond a side of the one, but for less than what counts? Faces that share a side or a corner do, and
// most pairs are such.
template <int dim>
bool lies_beyond_a_side(const WeightsAt<dim>& weights) {
  constexpr double thin = 0.1 * least_share;  // twice this share of either face may be in common
  const double sense = weights.whole < 0 ? -1 : 1, whole = std::abs(weights.whole);
  return std::any_of(weights.of.begin(), weights.of.end(), [&](const std::array<double, dim>& at) {
    double low = sense * at[0], high = low;
    for (int k = 1; k < dim; ++k) {
      low = std::min(low, sense * at[k]);
      high = std::max(high, sense * at[k]);
    }
    return high <= thin * std::min(whole, high - low);
  });
}

// A linear function on the first face, by its values at the corners.
template <int dim>
using Linear = std::array<double, dim>;

// From here on a place is given by the weights of the first face's corners but the first one.
template <int dim>
double value_at(const Linear<dim>& function, const Seen<dim>& place) {
  double value = function[0];
  for (int i = 1; i < dim; ++i) value += place[i - 1] * (function[i] - function[0]);
  return value;
}

// Weights of the second face's corners, and the gap.
template <int dim>
struct OnFirst {
  std::array<Linear<dim>, dim> on_second;
  Linear<dim> gap;
};

template <int dim>
OnFirst<dim> seen_from_first(const FacePair<dim>& pair, const WeightsAt<dim>& on_second) {
  OnFirst<dim> functions;
  const Point<dim>& origin = pair.first[0];  // so that rounding is that of a face
  for (int i = 0; i < dim; ++i) functions.gap[i] = -pair.normal.dot(pair.first[i] - origin);
  for (int j = 0; j < dim; ++j) {
    const double height = pair.normal.dot(pair.second[j] - origin);
    for (int i = 0; i < dim; ++i) {
      functions.on_second[j][i] = on_second.of[j][i] / on_second.whole;
      functions.gap[i] += functions.on_second[j][i] * height;
    }
  }
  return functions;
}

// Convex, in order. Each of the five lines that clip a triangle adds one corner; were all corners on it but for rounding, half
// as many again: never more than 19.
template <int dim>
class Polygon {
 public:
  Polygon() = default;
  Polygon(const Polygon& other) : size_(other.size_) { std::copy_n(other.places_.begin(), size_, places_.begin()); }

  [[nodiscard]] int size() const { return size_; }
  const Seen<dim>& operator[](int i) const { return places_[i]; }
  void add(const Seen<dim>& place) { places_[size_++] = place; }
  void clear() { size_ = 0; }

 private:
  std::array<Seen<dim>, 19> places_;
  int size_ = 0;
};

template <int dim>
Polygon<dim> whole_first() {
  Polygon<dim> polygon;
  for (int i = 0; i < dim; ++i) {
    Seen<dim> corner{};
    if (i > 0) corner[i - 1] = 1;
    polygon.add(corner);
  }
  return polygon;
}

// Keeps what lies where `offset` and `sign` times a linear function together are not negative.
template <int dim>
void clip(Polygon<dim>& polygon, const Linear<dim>& function, double sign, double offset) {
  if (polygon.size() < dim) return;
  std::array<double, 19> values;
  bool whole = true;
  for (int i = 0; i < polygon.size(); ++i) {
    values[i] = offset + sign * value_at<dim>(function, polygon[i]);
    whole = whole && values[i] >= 0;
  }
  if (whole) return;
  const Polygon<dim> all = polygon;
  const int sides = dim == 2 ? all.size() - 1 : all.size();
  polygon.clear();
  for (int i = 0; i < all.size(); ++i) {
    if (values[i] >= 0) polygon.add(all[i]);
    if (i >= sides) continue;
    const int next = i + 1 == all.size() ? 0 : i + 1;
    if ((values[i] < 0) == (values[next] < 0)) continue;
    const double way = values[i] / (values[i] - values[next]);
    Seen<dim> between = all[i];
    for (int k = 0; k < dim - 1; ++k) between[k] += way * (all[next][k] - all[i][k]);
    polygon.add(between);
  }
}

template <int dim>
Polygon<dim> overlap(const OnFirst<dim>& functions, double tolerance) {
  Polygon<dim> polygon = whole_first<dim>();
  for (const Linear<dim>& weight : functions.on_second) clip<dim>(polygon, weight, 1, 0);
  clip<dim>(polygon, functions.gap, -1, tolerance);
  clip<dim>(polygon, functions.gap, 1, tolerance);
  return polygon;
}

// Places of equal weight that integrate quadratic functions exactly, and the share of the first face that is theirs together.
template <int dim>
struct Quadrature {
  std::array<Seen<dim>, dim> places;
  double share = 0;
};

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
  double share = 0;
  Vector sum = Vector::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (int i = 2; i < polygon.size(); ++i) {
    const double piece = std::abs(spanned<3>(polygon[0], polygon[i - 1], polygon[i]));
    const Vector a = way_to(i - 1), b = way_to(i), both = a + b;
    share += piece;
    sum += piece / 3 * both;
    squares += piece / 12 * (a * a.transpose() + b * b.transpose() + both * both.transpose());
  }
  Quadrature<3> rule;
  rule.share = share;
  if (share == 0) return rule;
  const Vector mean = sum / share;
  const Eigen::Matrix2d variance = squares / share - mean * mean.transpose();
  // Its root: a lower triangle. Of what is as thin as rounding the second column may be nothing.
  const double along = std::sqrt(std::max(0.0, variance(0, 0)));
  const double skew = along > 0 ? variance(0, 1) / along : 0;
  const double across = std::sqrt(std::max(0.0, variance(1, 1) - skew * skew));
  Vector towards(1, 0);  // the first corner, as seen where the variance is one
  if (along > 0 && across > 0) {
    towards.x() = -mean.x() / along;
    towards.y() = (-mean.y() - skew * towards.x()) / across;
    towards.normalize();
  }
  const Vector aside(-towards.y(), towards.x());
  const std::array<Vector, 3> corners = {towards, -0.5 * towards + 0.5 * std::numbers::sqrt3 * aside,
                                         -0.5 * towards - 0.5 * std::numbers::sqrt3 * aside};
  for (int i = 0; i < 3; ++i) {
    const Vector far = std::numbers::sqrt2 * corners[i];
    rule.places[i] = {polygon[0][0] + mean.x() + along * far.x(), polygon[0][1] + mean.y() + skew * far.x() + across * far.y()};
  }
  return rule;
}

template <int dim>
OverlapPoint<dim> as_point(const OnFirst<dim>& functions, const Seen<dim>& place, double area) {
  OverlapPoint<dim> point;
  point.on_first[0] = 1;
  for (int i = 1; i < dim; ++i) {
    point.on_first[i] = place[i - 1];
    point.on_first[0] -= place[i - 1];
  }
  for (int j = 0; j < dim; ++j) point.on_second[j] = value_at<dim>(functions.on_second[j], place);
  point.area = area;
  point.gap = value_at<dim>(functions.gap, place);
  return point;
}

}  // namespace

template <int dim>
void overlap_points(const FacePair<dim>& pair, double tolerance, std::vector<OverlapPoint<dim>>& points) {
  points.clear();
  const Sight<dim> sight(pair.normal, pair.first[0]);
  const auto first = sight.of(pair.first), second = sight.of(pair.second);
  const auto on_second = weights_at<dim>(second, first);
  if (lies_beyond_a_side<dim>(on_second)) return;
  const auto on_first = weights_at<dim>(first, second);
  if (lies_beyond_a_side<dim>(on_first)) return;
  const OnFirst<dim> functions = seen_from_first(pair, on_second);
  const Polygon<dim> polygon = overlap(functions, tolerance);
  if (polygon.size() < dim) return;
  const Quadrature<dim> rule = quadrature(polygon);
  const double measure = dim == 2 ? 1 : 0.5;
  const double first_area = measure * sight.area(on_first.whole), second_area = measure * sight.area(on_second.whole);
  if (rule.share * first_area <= least_share * std::min(first_area, second_area)) return;
  for (const Seen<dim>& place : rule.places) points.push_back(as_point(functions, place, rule.share * first_area / dim));
}

template void overlap_points<2>(const FacePair<2>&, double, std::vector<OverlapPoint<2>>&);
template void overlap_points<3>(const FacePair<3>&, double, std::vector<OverlapPoint<3>>&);

}  // namespace scree::contact
