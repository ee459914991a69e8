#include "contact/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace scree::contact {

namespace {

constexpr double least_share = 1e-13;  // of the smaller face

// A point of the overlap: its weights on the first face, then on the second.
template <int dim>
using Place = Eigen::Matrix<double, 2 * dim, 1>;

// Convex, in order. Each of the five lines that clip a triangle adds one corner; were all corners on it but for rounding, half
// as many again: never more than 19.
template <int dim>
class Polygon {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  const Place<dim>& operator[](std::size_t i) const { return places_[i]; }
  Place<dim>& operator[](std::size_t i) { return places_[i]; }
  void push_back(const Place<dim>& place) { places_[size_++] = place; }
  void assign(const Polygon& other) {
    size_ = other.size_;
    std::copy_n(other.places_.begin(), size_, places_.begin());
  }

 private:
  std::array<Place<dim>, 19> places_;
  std::size_t size_ = 0;
};

// Area of a face as seen along the normal, with the sign of its sense of rotation.
template <int dim>
double seen_area(const Corners<dim>& corners, const Point<dim>& normal) {
  if constexpr (dim == 2) {
    const Point<2> way = corners[1] - corners[0];
    return normal.y() * way.x() - normal.x() * way.y();
  } else {
    return 0.5 * normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0]));
  }
}

// How the weight of a corner grows with the place, as seen along the normal, times twice the face's area as seen so.
template <int dim>
Point<dim> weight_slope(const Corners<dim>& corners, int corner, const Point<dim>& normal) {
  if constexpr (dim == 2) {
    const double sign = corner == 0 ? -1 : 1;
    return {sign * normal.y(), -sign * normal.x()};
  } else {
    return normal.cross(corners[(corner + 2) % 3] - corners[(corner + 1) % 3]);
  }
}

// Does a face lie beyond a side of another one, seen along the normal, but for less than what counts? Faces that share a side
// or a corner do, and most pairs are such.
template <int dim>
bool lies_beyond_a_side(const Corners<dim>& face, const Corners<dim>& of, const Point<dim>& normal) {
  constexpr double thin = 0.1 * least_share;  // twice this share of either face may be in common
  for (int j = 0; j < dim; ++j) {
    const Point<dim> slope = weight_slope<dim>(of, j, normal);
    const Point<dim>& side = of[(j + 1) % dim];
    const double whole = slope.dot(of[j] - side);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point<dim>& corner : face) {
      const double weight = slope.dot(corner - side) / whole;
      low = std::min(low, weight);
      high = std::max(high, weight);
    }
    if (high <= thin * std::min(1.0, high - low)) return true;
  }
  return false;
}

// The first face, each corner with its weights on the second, as seen along the normal.
template <int dim>
Polygon<dim> whole_first(const FacePair<dim>& pair) {
  const double area = seen_area<dim>(pair.second, pair.normal);
  Polygon<dim> polygon;
  for (int i = 0; i < dim; ++i) {
    polygon.push_back(Place<dim>::Unit(i));
    for (int j = 0; j < dim; ++j) {
      Corners<dim> part = pair.second;
      part[j] = pair.first[i];
      polygon[i][dim + j] = seen_area<dim>(part, pair.normal) / area;
    }
  }
  return polygon;
}

// Keeps what lies where the linear function `value` is not negative.
template <int dim>
void clip(Polygon<dim>& polygon, const Place<dim>& value) {
  bool whole = true;
  for (std::size_t i = 0; i < polygon.size(); ++i) whole = whole && value.dot(polygon[i]) >= 0;
  if (whole) return;
  Polygon<dim> kept;
  const std::size_t sides = dim == 2 ? polygon.size() - 1 : polygon.size();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place<dim>& from = polygon[i];
    const double here = value.dot(from);
    if (here >= 0) kept.push_back(from);
    if (i >= sides) continue;
    const Place<dim>& to = polygon[(i + 1) % polygon.size()];
    const double there = value.dot(to);
    if ((here < 0) != (there < 0)) kept.push_back(from + here / (here - there) * (to - from));
  }
  polygon.assign(kept);
}

// The gap as a function of the weights.
template <int dim>
Place<dim> gap_function(const FacePair<dim>& pair) {
  Place<dim> gap;
  for (int i = 0; i < dim; ++i) {
    // From one corner, so that rounding is that of a face and not of its distance from the origin.
    gap[i] = -pair.normal.dot(pair.first[i] - pair.first[0]);
    gap[dim + i] = pair.normal.dot(pair.second[i] - pair.first[0]);
  }
  return gap;
}

template <int dim>
Polygon<dim> overlap(const FacePair<dim>& pair, const Place<dim>& gap, double tolerance) {
  Polygon<dim> polygon = whole_first(pair);
  Place<dim> one = Place<dim>::Zero();
  one.template head<dim>().setOnes();
  for (int j = 0; j < dim && polygon.size() >= dim; ++j) clip<dim>(polygon, Place<dim>::Unit(dim + j));
  if (polygon.size() >= dim) clip<dim>(polygon, tolerance * one - gap);
  if (polygon.size() >= dim) clip<dim>(polygon, tolerance * one + gap);
  return polygon;
}

// Share of the first face between `dim` places.
template <int dim>
double share(const std::array<Place<dim>, dim>& places) {
  Eigen::Matrix<double, dim, dim> weights;
  for (int i = 0; i < dim; ++i) weights.col(i) = places[i].template head<dim>();
  if constexpr (dim == 2) {
    return std::abs(weights(0, 0) - weights(0, 1));
  } else {
    return std::abs(weights.determinant());
  }
}

// Calls use(part) with the segment, or with the triangles of a fan.
template <int dim, class Use>
void for_each_simplex(const Polygon<dim>& polygon, const Use& use) {
  for (std::size_t i = dim - 1; i < polygon.size(); ++i) {
    if constexpr (dim == 2) {
      use(std::array<Place<2>, 2>{polygon[i - 1], polygon[i]});
    } else {
      use(std::array<Place<3>, 3>{polygon[0], polygon[i - 1], polygon[i]});
    }
  }
}

template <int dim>
OverlapPoint<dim> as_point(const Place<dim>& place, double area, double gap) {
  OverlapPoint<dim> point;
  for (int i = 0; i < dim; ++i) {
    point.on_first[i] = place[i];
    point.on_second[i] = place[dim + i];
  }
  point.area = area;
  point.gap = gap;
  return point;
}

}  // namespace

template <int dim>
void overlap_points(const FacePair<dim>& pair, double tolerance, std::vector<OverlapPoint<dim>>& points) {
  points.clear();
  if (lies_beyond_a_side<dim>(pair.first, pair.second, pair.normal)) return;
  if (lies_beyond_a_side<dim>(pair.second, pair.first, pair.normal)) return;
  const Place<dim> gap = gap_function(pair);
  const Polygon<dim> polygon = overlap(pair, gap, tolerance);
  const double first_area = std::abs(seen_area<dim>(pair.first, pair.normal));
  const double second_area = std::abs(seen_area<dim>(pair.second, pair.normal));
  double area = 0;
  for_each_simplex<dim>(polygon, [&](const auto& part) { area += share<dim>(part) * first_area; });
  if (area <= least_share * std::min(first_area, second_area)) return;

  // Exact for quadratic functions: Gauss's rule on a segment, the points (2/3, 1/6, 1/6) of a triangle.
  const double near = dim == 2 ? 0.5 + 0.5 / std::sqrt(3.0) : 2.0 / 3;
  const double far = (1 - near) / (dim - 1);
  for_each_simplex<dim>(polygon, [&](const auto& part) {
    const double piece = share<dim>(part) * first_area / dim;
    if (piece == 0) return;
    for (int i = 0; i < dim; ++i) {
      Place<dim> place = Place<dim>::Zero();
      for (int j = 0; j < dim; ++j) place += (i == j ? near : far) * part[j];
      points.push_back(as_point<dim>(place, piece, gap.dot(place)));
    }
  });
}

template void overlap_points<2>(const FacePair<2>&, double, std::vector<OverlapPoint<2>>&);
template void overlap_points<3>(const FacePair<3>&, double, std::vector<OverlapPoint<3>>&);

}  // namespace scree::contact
