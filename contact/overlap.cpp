#include "contact/overlap.h"

#include <algorithm>
#include <cmath>

#include "contact/polygon.h"
#include "contact/quadrature.h"

namespace scree::contact {

namespace {

constexpr double least_share = 1e-13;  // of the smaller face

template <int dim>
using SeenFace = std::array<Seen<dim>, dim>;

// How points are seen along a normal: carried along it into a plane of two axes (2-D: onto one). Weights on a face are the same
// as in the plane across the normal, areas larger.
template <int dim>
class Sight {
 public:
  Sight(const Point<dim>& normal, const Point<dim>& origin) : origin_(origin) {
    normal.cwiseAbs().maxCoeff(&depth_);
    tilt_ = 1 / normal[depth_] * normal;
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

// On the first face: weights of the second one's corners, and the gap.
template <int dim>
struct OnFirst {
  std::array<Linear<dim>, dim> on_second;
  Linear<dim> gap;
};

template <int dim>
OnFirst<dim> seen_from_first(const FacePair<dim>& pair, const WeightsAt<dim>& on_second) {
  OnFirst<dim> functions;
  const double scale = 1 / on_second.whole;
  const Point<dim>& origin = pair.first[0];  // so that rounding is that of a face
  for (int i = 0; i < dim; ++i) functions.gap[i] = -pair.normal.dot(pair.first[i] - origin);
  for (int j = 0; j < dim; ++j) {
    const double height = pair.normal.dot(pair.second[j] - origin);
    for (int i = 0; i < dim; ++i) {
      functions.on_second[j][i] = scale * on_second.of[j][i];
      functions.gap[i] += functions.on_second[j][i] * height;
    }
  }
  return functions;
}

template <int dim>
Polygon<dim> overlap(const OnFirst<dim>& functions, double tolerance) {
  Polygon<dim> polygon = whole_face<dim>();
  for (const Linear<dim>& weight : functions.on_second) clip<dim>(polygon, weight, 1, 0);
  clip<dim>(polygon, functions.gap, -1, tolerance);
  clip<dim>(polygon, functions.gap, 1, tolerance);
  return polygon;
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
  const Quadrature<dim> rule = quadrature(polygon);  // places being weights, a size of 1 is all of the first face
  const double measure = dim == 2 ? 1 : 0.5;
  const double first_area = measure * sight.area(on_first.whole), second_area = measure * sight.area(on_second.whole);
  if (rule.size * first_area <= least_share * std::min(first_area, second_area)) return;
  for (const Seen<dim>& place : rule.places) points.push_back(as_point(functions, place, rule.size * first_area / dim));
}

template void overlap_points<2>(const FacePair<2>&, double, std::vector<OverlapPoint<2>>&);
template void overlap_points<3>(const FacePair<3>&, double, std::vector<OverlapPoint<3>>&);

}  // namespace scree::contact
