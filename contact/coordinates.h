// Points and directions whose coordinates are one number, or four or eight at once: the same operations, in the same order, so
// the same bits.
#pragma once

#include <array>
#include <cmath>

#include "engine/base/geometry.h"
#include "engine/base/quad.h"

namespace scree::contact {

template <int dim, class Number>
using Coordinates = std::array<Number, dim>;

template <int dim>
SCREE_INLINE Coordinates<dim, double> coordinates(const Point<dim>& point) {
  Coordinates<dim, double> result;
  for (int i = 0; i < dim; ++i) result[i] = point[i];
  return result;
}

// 1 or 0, so that & and | are the same for one number and for several.
SCREE_INLINE int below(double a, double b) {
  return a < b ? 1 : 0;
}
SCREE_INLINE int at_most(double a, double b) {
  return a <= b ? 1 : 0;
}
SCREE_INLINE double chosen(int first, double a, double b) {
  return first != 0 ? a : b;
}
SCREE_INLINE double root(double square) {
  return std::sqrt(square);
}

SCREE_INLINE auto below(const Quad& a, const Quad& b) {
  return a < b;
}
SCREE_INLINE auto at_most(const Quad& a, const Quad& b) {
  return a <= b;
}
SCREE_INLINE Quad chosen(const decltype(Quad{} < Quad{}) & first, const Quad& a, const Quad& b) {
  return first ? a : b;
}
SCREE_INLINE Quad root(const Quad& square) {
#ifdef __SSE2__
  // By twos: a function that is compiled for narrow instructions, too, cannot ask for a root of four.
  const auto low = __builtin_shufflevector(square, square, 0, 1), high = __builtin_shufflevector(square, square, 2, 3);
  return __builtin_shufflevector(__builtin_ia32_sqrtpd(low), __builtin_ia32_sqrtpd(high), 0, 1, 2, 3);
#else
  return Quad{std::sqrt(square[0]), std::sqrt(square[1]), std::sqrt(square[2]), std::sqrt(square[3])};
#endif
}

#ifdef SCREE_HAS_AVX2
// Eight have masks of one bit each. The compiler does not find these by itself: when it reads a comparison it does not know yet
// what it will be inlined into.
inline constexpr int rounding_as_set = 4;

SCREE_INLINE unsigned below(const Octet& a, const Octet& b) {
  return __builtin_ia32_cmppd512_mask(a, b, 1, 0xff, rounding_as_set);
}
SCREE_INLINE unsigned at_most(const Octet& a, const Octet& b) {
  return __builtin_ia32_cmppd512_mask(a, b, 2, 0xff, rounding_as_set);
}
SCREE_INLINE Octet chosen(unsigned first, const Octet& a, const Octet& b) {
  return __builtin_ia32_blendmpd_512_mask(b, a, static_cast<unsigned char>(first));
}
SCREE_INLINE Octet root(const Octet& square) {
  return __builtin_ia32_sqrtpd512_mask(square, square, -1, rounding_as_set);
}
#endif

// What a comparison of numbers gives: 1 or 0, all bits of a lane or none, or a bit for each.
template <class Number>
using MaskOf = decltype(below(Number{}, Number{}));

template <int dim, class Number>
SCREE_INLINE Coordinates<dim, Number> minus(const Coordinates<dim, Number>& a, const Coordinates<dim, Number>& b) {
  Coordinates<dim, Number> result;
  for (int i = 0; i < dim; ++i) result[i] = a[i] - b[i];
  return result;
}

template <int dim, class Number>
SCREE_INLINE Number dot(const Coordinates<dim, Number>& a, const Coordinates<dim, Number>& b) {
  Number sum = a[0] * b[0];
  for (int i = 1; i < dim; ++i) sum += a[i] * b[i];
  return sum;
}

template <class Number>
SCREE_INLINE Coordinates<3, Number> cross(const Coordinates<3, Number>& a, const Coordinates<3, Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace scree::contact
