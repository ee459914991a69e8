// What is the same for eight lanes and for sixteen. A function that is called by `widely` works on those in the vectors it is
// compiled for: LanesIn<bytes>.
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include "contact/wide_lanes.h"

namespace scree::contact {

template <int bytes>
using LanesIn = std::conditional_t<bytes == sizeof(WidestLanes), WidestLanes, WideLanes>;

template <class Wide>
inline constexpr int count_of = sizeof(Wide) / sizeof(float);
template <class Wide>
inline constexpr int fours_of = count_of<Wide> / lane_count;

// Whole numbers, one a lane: which lane to take, say.
template <class Wide>
using PlacesIn = std::conditional_t<std::is_same_v<Wide, WidestLanes>, WidestPlaces, WideMask>;

// Calls visit(integral constant) for 0 to count - 1.
template <int count, class Visit>
SCREE_INLINE void for_each_constant(const Visit& visit) {
  [&]<int... i>(std::integer_sequence<int, i...>) SCREE_INLINED {
    (visit(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, count>{});
}

// One four after the other.
template <class Wide>
SCREE_INLINE Wide in_a_row(const std::array<Lanes, fours_of<Wide>>& fours) {
  Wide all;
  put_in_a_row(fours, all);
  return all;
}

// Of pairs, one for every eight lanes: of each what low(its number) and high(its number) give, four lanes or one number for
// four.
template <class Wide, class Low, class High>
SCREE_INLINE Wide in_halves(const Low& low, const High& high) {
  std::array<decltype(low(0)), fours_of<Wide>> fours;
  for_each_constant<fours_of<Wide> / 2>([&](auto pair) SCREE_INLINED {
    fours[2 * pair] = low(pair);
    fours[2 * pair + 1] = high(pair);
  });
  Wide all;
  if constexpr (std::is_same_v<decltype(low(0)), float>) {
    put_in_fours(fours, all);
  } else {
    put_in_a_row(fours, all);
  }
  return all;
}

// One number for every eight lanes.
template <class Wide, class Number>
SCREE_INLINE Wide in_eights(const Number& number) {
  return in_halves<Wide>(number, number);
}

// Of each four one lane in all of them.
template <int lane, class Wide>
SCREE_INLINE Wide in_fours(const Wide& a) {
  return ordered_fours<lane, lane, lane, lane>(a);
}

// Of each four the least lane in all of them.
template <class Wide>
SCREE_INLINE Wide least_in_fours(const Wide& a) {
  const Wide of_two = least(a, ordered_fours<1, 0, 3, 2>(a));
  return least(of_two, ordered_fours<2, 3, 0, 1>(of_two));
}

// Four lanes again and again, or one number.
template <class Wide>
SCREE_INLINE Wide repeated(const Lanes& a) {
  Wide all;
  repeat(a, all);
  return all;
}
template <class Wide>
SCREE_INLINE Wide repeated(float a) {
  Wide all;
  repeat(a, all);
  return all;
}

template <class Wide>
SCREE_INLINE Wide absolute(const Wide& a) {
  return most(a, -a);
}

// Lane i is lane places[i] of a, of which the lowest bits count, as many as there are for the lanes.
template <class Wide, class Places>
SCREE_INLINE Wide shuffled(const Wide& a, const Places& places) {
#ifdef __clang__
  Wide result;
  for (int i = 0; i < count_of<Wide>; ++i) result[i] = a[places[i] & (count_of<Wide> - 1)];
  return result;
#else
  return __builtin_shuffle(a, places);
#endif
}

// At least the length of a vector and at most 1.16 times as much, without a root, which is slow.
template <class Wide>
SCREE_INLINE Wide most_length(const Coordinates<3, Wide>& vector) {
  const Wide x = absolute(vector[0]), y = absolute(vector[1]), z = absolute(vector[2]);
  return 0.5F * (x + y + z + most(x, most(y, z)));
}

// How far a place is before the start, 0, or behind the end, less than 0 in between.
template <class Wide>
SCREE_INLINE Wide beyond_ends(const Wide& along, const Wide& end) {
  return most(-along, along - end);
}

// In each lane that of the points whose number the lowest bits say.
template <class Wide, class Places>
SCREE_INLINE Coordinates<3, Wide> picked(const Coordinates<3, Wide>& points, const Places& numbers) {
  return {shuffled(points[0], numbers), shuffled(points[1], numbers), shuffled(points[2], numbers)};
}

}  // namespace scree::contact
