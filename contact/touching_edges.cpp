#include <algorithm>
#include <bit>

#include "contact/edge_bounds.h"
#include "contact/segment.h"
#include "contact/wide_lanes.h"

namespace scree::contact {

namespace {

SCREE_INLINE LanePoints<3> scaled(const LanePoints<3>& points, float unit) {
  return {unit * points[0], unit * points[1], unit * points[2]};
}

// The vertices that are asked of two edges, as places in the words below.
enum Corner { start, end, left, right, of_second };  // left and right: the vertices beside the edge

// Of a pair of edges by the number of its bit in EdgePairs the vertices of both, four bits each.
constexpr std::array<std::uint32_t, 64> vertices_of_pairs = [] {
  std::array<std::uint32_t, 64> words{};
  const auto word = [](const ElementEdge& edge) {
    const std::array<int, of_second> vertices{edge.start, edge.end, edge.beside[0], edge.beside[1]};
    std::uint32_t all = 0;
    for (int i = 0; i < of_second; ++i) all |= static_cast<std::uint32_t>(vertices[i]) << 4 * i;
    return all;
  };
  for (unsigned i = 0; i < 36; ++i) words[i] = word(element_edges[i / 6]) | word(element_edges[i % 6]) << 4 * of_second;
  return words;
}();

// As many pairs of an edge of the first with one of the second as there are lanes: in the low half those of two shells, in the
// high half those of two others.
struct SomePairs {
  std::array<std::uint8_t, wide_count> numbers;  // of their bits in EdgePairs
  WideMask vertices;                             // words as above
  unsigned asked = 0;                            // bit i: there is a pair i
};

// Where the lines of some pairs of edges come closest.
struct Crossing {
  WideLanes square;         // of the common normal, the cross product of the edges
  WideLanes along_first;    // fraction of the way along the edge of the first, times that square
  WideLanes along_second;   // the same on the edge of the second
  WidePoints across_first;  // from the edge of the first sideways, in the plane of both
  WidePoints across_second;
  WidePoints start_first;  // of the edges
  WidePoints start_second;
  WideLanes off_first, off_second;  // of along_first and along_second, by rounding
  unsigned near = 0;                // bit i: the pair i may touch, as far as this tells
};

// Of some pairs, one bit each, as in TouchingEdges.
struct TouchingSome {
  std::array<unsigned, 2> of_first{};
  std::array<unsigned, 2> of_second{};

  [[nodiscard]] bool any() const { return (of_first[0] | of_first[1] | of_second[0] | of_second[1]) != 0; }
};

// Of two shells what is asked of their edges. Lengths are in radii of the first, so that their products keep within the range
// of single precision.
struct Scaled {
  Scaled() = default;
  SCREE_INLINE Scaled(const Shell<3>& a, const Shell<3>& b, float indentation) {
    const Way<3> way(a, b);
    const float unit = 1 / a.radius;
    distance = unit * slack(a, b);
    off = 2 * unit * way.rounding;
    aside = 2 * indentation / 3 * unit * std::max(a.radius, b.radius);
    first = scaled(a.at, unit);
    second = scaled(vertices_from(b, way), unit);
  }

  float distance;  // between the lines of edges that touch, at most
  float off;       // of a length, by rounding
  float aside;     // the third corner of a face, no further from an edge than two radii, moves its semi-edges by no more
  LanePoints<3> first, second;  // their vertices as seen from the first
};

// The semi-edges beside the edges of two times two shells, some pairs of edges at a time.
class EdgeBounds {
 public:
  SCREE_INLINE EdgeBounds(const Scaled& low, const Scaled& high, float indentation)
      : distance_(joined(low.distance, high.distance)),
        off_(joined(low.off, high.off)),
        aside_(joined(low.aside, high.aside)),
        kept_(1 - indentation),
        moved_(indentation / 3),
        first_(joined(low.first, high.first)),
        second_(joined(low.second, high.second)) {}

  // The fractions along both edges are line_crossing's, times the square of the common normal. A semi-edge crosses the other
  // edge between the ends of both, seen along the normal: its start is moved by a share of the way along its edge, which moves
  // it by as much along the edge and not across it, and by the same share of the way to the third corner of its face.
  SCREE_INLINE void may_touch(const SomePairs& pairs, TouchingSome& touching) const {
    Crossing lines;
    cross_lines(pairs, lines);
    if (lines.near == 0) return;
    const WideLanes moved_along = moved_ * lines.square, kept = kept_ * lines.square;
    for (std::size_t k = 0; k < 2; ++k) {
      // The face beside one of the two other vertices has the other one as its third corner.
      const int third = k == 0 ? right : left;
      const WidePoints a = minus(of_first(pairs, third), lines.start_first);
      const WidePoints b = minus(of_second_shell(pairs, third), lines.start_second);
      const WideLanes own_first = lines.along_first - moved_along - moved_ * dot(a, lines.across_second);
      const WideLanes target_second = lines.along_second + moved_ * dot(a, lines.across_first);
      touching.of_first[k] =
          lines.near & bits(within(own_first, kept, lines.off_first) & within(target_second, lines.square, lines.off_second));
      const WideLanes own_second = lines.along_second - moved_along - moved_ * dot(b, lines.across_first);
      const WideLanes target_first = lines.along_first + moved_ * dot(b, lines.across_second);
      touching.of_second[k] =
          lines.near & bits(within(own_second, kept, lines.off_second) & within(target_first, lines.square, lines.off_first));
    }
  }

 private:
  // A vertex of the edge of the first of each pair, and of the second.
  SCREE_INLINE WidePoints of_first(const SomePairs& pairs, int corner) const {
    return picked(first_, pairs.vertices >> 4 * corner);
  }
  SCREE_INLINE WidePoints of_second_shell(const SomePairs& pairs, int corner) const {
    return picked(second_, pairs.vertices >> 4 * (of_second + corner));
  }

  SCREE_INLINE void cross_lines(const SomePairs& pairs, Crossing& lines) const {
    lines.start_first = of_first(pairs, start);
    lines.start_second = of_second_shell(pairs, start);
    const WidePoints a = minus(of_first(pairs, end), lines.start_first);
    const WidePoints b = minus(of_second_shell(pairs, end), lines.start_second);
    const WidePoints between = minus(lines.start_second, lines.start_first);
    const WidePoints normal = cross(a, b);
    lines.square = dot(normal, normal);
    lines.across_first = cross(normal, a);
    lines.across_second = cross(b, normal);
    lines.along_first = dot(between, lines.across_second);
    lines.along_second = -dot(between, lines.across_first);
    const WideLanes a_square = dot(a, a), b_square = dot(b, b), volume = dot(between, normal);
    const WideLanes a_length = most_length(a), b_length = most_length(b), off = off_ * a_length * b_length;
    lines.off_first = off * b_length;
    lines.off_second = off * a_length;
    // Beside the place of the edges that of a semi-edge: its shift from the start times a vector across.
    const WideLanes aside = aside_ * most_length(normal);
    constexpr float least_square = 0.99F * static_cast<float>(least_crossing_sine * least_crossing_sine);
    // The square of a sum x + y is at most 1.01 x^2 + 101 y^2.
    const auto near_lines = volume * volume <= 1.01F * distance_ * distance_ * lines.square + 101.0F * off * off;
    const auto crossing = lines.square >= least_square * a_square * b_square;
    lines.near = bits(near_lines & crossing & within(lines.along_first, lines.square, lines.off_first + aside * b_length) &
                      within(lines.along_second, lines.square, lines.off_second + aside * a_length));
  }

  WideLanes distance_, off_, aside_;
  float kept_;                 // length of a semi-edge, over that of its edge
  float moved_;                // share of each corner of its face in a semi-spring
  WidePoints first_, second_;  // vertices
};

// Goes through many pairs of shells with two of them at hand, one in each half of the lanes.
class Halves {
 public:
  SCREE_INLINE Halves(const std::vector<ShellEdges>& shells, float indentation, std::vector<TouchingEdges>& touching)
      : shells_(shells), indentation_(indentation), touching_(touching) {}

  // Fills halves that have nothing left. False if there is nothing in either.
  SCREE_INLINE bool fill() {
    for (int half = 0; half < 2; ++half) {
      if (left_[half] != 0 || next_ == shells_.size()) continue;
      const auto& [first, second, edges] = shells_[next_];
      scaled_[half] = Scaled(*first, *second, indentation_);
      left_[half] = edges;
      at_[half] = next_++;
    }
    return (left_[0] | left_[1]) != 0;
  }

  [[nodiscard]] SCREE_INLINE EdgeBounds bounds() const { return {scaled_[0], scaled_[1], indentation_}; }

  // Takes some pairs from both halves; lanes without one are of no matter.
  SCREE_INLINE void take(SomePairs& pairs) {
    std::array<std::uint32_t, wide_count> words;
    pairs.asked = 0;
    for (int half = 0; half < 2; ++half) {
      constexpr std::uint32_t in_high_half = 0x44444444;  // added to each vertex
      EdgePairs& left = left_[half];
      for (int i = lane_count * half; i < lane_count * (half + 1); ++i) {
        pairs.asked |= (left != 0 ? 1u : 0u) << i;
        pairs.numbers[i] = static_cast<std::uint8_t>(std::countr_zero(left) & 63);
        words[i] = vertices_of_pairs[pairs.numbers[i]] + (half == 0 ? 0 : in_high_half);
        left &= left - 1;
      }
    }
    for (int i = 0; i < wide_count; ++i) pairs.vertices[i] = static_cast<int>(words[i]);
  }

  SCREE_INLINE void keep(const TouchingSome& found, const SomePairs& pairs) {
    for (std::size_t k = 0; k < 2; ++k) {
      keep(found.of_first[k] & pairs.asked, pairs,
           [&](TouchingEdges& of) SCREE_INLINED -> EdgePairs& { return of.of_first[k]; });
      keep(found.of_second[k] & pairs.asked, pairs,
           [&](TouchingEdges& of) SCREE_INLINED -> EdgePairs& { return of.of_second[k]; });
    }
  }

 private:
  template <class SetOf>
  SCREE_INLINE void keep(unsigned found, const SomePairs& pairs, const SetOf& set_of) {
    for (; found != 0; found &= found - 1) {
      const int i = std::countr_zero(found);
      set_of(touching_[at_[i / lane_count]]) |= EdgePairs{1} << pairs.numbers[i];
    }
  }

  const std::vector<ShellEdges>& shells_;
  float indentation_;
  std::vector<TouchingEdges>& touching_;
  std::size_t next_ = 0;
  std::array<std::size_t, 2> at_{};
  std::array<EdgePairs, 2> left_{};
  std::array<Scaled, 2> scaled_{};
};

}  // namespace

void find_touching_edges(const std::vector<ShellEdges>& shells, double indentation, std::vector<TouchingEdges>& touching) {
  touching.assign(shells.size(), {});
  widely([&]() SCREE_INLINED {
    Halves halves(shells, static_cast<float>(indentation), touching);
    while (halves.fill()) {
      SomePairs some;
      halves.take(some);
      TouchingSome found;
      halves.bounds().may_touch(some, found);
      if (found.any()) halves.keep(found, some);
    }
  });
}

}  // namespace scree::contact
