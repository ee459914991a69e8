// Convex polygons in a plane (2-D: segments on a line), and what linear functions cut off from them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace scree::contact {

// A place in a plane (2-D: on a line).
template <int dim>
using Seen = std::array<double, dim - 1>;

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

// Each of the five lines that clip a triangle adds one corner; were all corners on it but for rounding, half as many again.
inline constexpr int most_corners = 19;

// Convex, in order.
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
  std::array<Seen<dim>, most_corners> places_;
  int size_ = 0;
};

// A linear function on a face, by its values at the corners.
template <int dim>
using Linear = std::array<double, dim>;

// At a place that is given by the weights of the corners but the first one.
template <int dim>
double value_at(const Linear<dim>& function, const Seen<dim>& place) {
  double value = function[0];
  for (int i = 1; i < dim; ++i) value += place[i - 1] * (function[i] - function[0]);
  return value;
}

// A whole face, places given as above.
template <int dim>
Polygon<dim> whole_face() {
  Polygon<dim> polygon;
  for (int i = 0; i < dim; ++i) {
    Seen<dim> corner{};
    if (i > 0) corner[i - 1] = 1;
    polygon.add(corner);
  }
  return polygon;
}

// Keeps of such a polygon what lies where `offset` and `sign` times a linear function together are not negative.
template <int dim>
void clip(Polygon<dim>& polygon, const Linear<dim>& function, double sign, double offset) {
  if (polygon.size() < dim) return;
  std::array<double, most_corners> values;
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

}  // namespace scree::contact
