#include <algorithm>
#include <bit>

#include "contact/edge_bounds.h"
#include "contact/lanes_in.h"
#include "contact/segment.h"

namespace scree::contact {

namespace {

// The vertices that are asked of two edges, as places in the words below.
enum Corner { start, end, left, right, of_second };  // left and right: the vertices beside the edge

// Of an edge of the first shell of a pair the vertices, four bits each.
constexpr std::array<int, 6> vertices_of_edges = [] {
  std::array<int, 6> words{};
  for (std::size_t e = 0; e < words.size(); ++e) {
    const std::array<int, of_second> vertices{element_edges[e].start, element_edges[e].end, element_edges[e].beside[0],
                                              element_edges[e].beside[1]};
    for (int i = 0; i < of_second; ++i) words[e] |= vertices[i] << 4 * i;
  }
  return words;
}();

// As many pairs of an edge of the first with one of the second as there are lanes: in each four of them those of two shells.
template <class Wide>
struct SomePairs {
  PlacesIn<Wide> numbers;   // of their bits in EdgePairs
  PlacesIn<Wide> vertices;  // of both edges, four bits each, those of the second above those of the first
  unsigned asked = 0;       // bit i: there is a pair i
};

// Where the lines of some pairs of edges come closest.
template <class Wide>
struct Crossing {
  Wide square;                        // of the common normal, the cross product of the edges
  Wide along_first;                   // fraction of the way along the edge of the first, times that square
  Wide along_second;                  // the same on the edge of the second
  Coordinates<3, Wide> across_first;  // from the edge of the first sideways, in the plane of both
  Coordinates<3, Wide> across_second;
  Coordinates<3, Wide> start_first;  // of the edges
  Coordinates<3, Wide> start_second;
  Wide off_first, off_second;  // of along_first and along_second, by rounding
  unsigned near = 0;           // bit i: the pair i may touch, as far as this tells
};

// Of some pairs, one bit each, as in TouchingEdges.
struct TouchingSome {
  std::array<unsigned, 2> of_first{};
  std::array<unsigned, 2> of_second{};

  [[nodiscard]] bool any() const { return (of_first[0] | of_first[1] | of_second[0] | of_second[1]) != 0; }
};

// Two shells whose edges are asked.
struct ShellsAsked {
  ShellsAsked() = default;
  SCREE_INLINE ShellsAsked(const Shell<3>& a, const Shell<3>& b) : first(&a), second(&b), way(a, b), distance(slack(a, b)) {}

  const Shell<3>* first = nullptr;
  const Shell<3>* second = nullptr;
  Way<3> way;
  float distance = 0;  // between edges that touch, at most [m]
};

// The semi-edges beside the edges of as many times two shells as there are fours of lanes, some pairs of edges at a time.
template <class Wide>
class EdgeBounds {
  using Points = Coordinates<3, Wide>;

 public:
  using Fours = std::array<ShellsAsked, fours_of<Wide>>;

  // Lengths are in radii of the first, so that their products keep within the range of single precision.
  SCREE_INLINE EdgeBounds(const Fours& shells, float kept, float moved) : kept_(kept), moved_(moved) {
    const Wide radius = numbers(shells, [](const ShellsAsked& of) SCREE_INLINED { return of.first->radius; });
    const Wide unit = 1 / radius;
    distance_ = unit * numbers(shells, [](const ShellsAsked& of) SCREE_INLINED { return of.distance; });
    off_ = 2 * unit * numbers(shells, [](const ShellsAsked& of) SCREE_INLINED { return of.way.rounding; });
    aside_ =
        2 * moved * unit * most(radius, numbers(shells, [](const ShellsAsked& of) SCREE_INLINED { return of.second->radius; }));
    for (int i = 0; i < 3; ++i) {
      const Wide way = numbers(shells, [&](const ShellsAsked& of) SCREE_INLINED { return of.way.axes[i]; });
      first_[i] = unit * lanes(shells, [&](const ShellsAsked& of) SCREE_INLINED { return of.first->at[i]; });
      second_[i] = unit * (lanes(shells, [&](const ShellsAsked& of) SCREE_INLINED { return of.second->at[i]; }) + way);
    }
  }

  // The fractions along both edges are line_crossing's, times the square of the common normal. A semi-edge crosses the other
  // edge between the ends of both, seen along the normal: its start is moved by a share of the way along its edge, which moves
  // it by as much along the edge and not across it, and by the same share of the way to the third corner of its face.
  SCREE_INLINE void may_touch(const SomePairs<Wide>& pairs, TouchingSome& touching) const {
    Crossing<Wide> lines;
    cross_lines(pairs, lines);
    lines.near &= pairs.asked;
    if (lines.near == 0) return;
    const Wide moved_along = moved_ * lines.square, kept = kept_ * lines.square;
    for (std::size_t k = 0; k < 2; ++k) {
      // The face beside one of the two other vertices has the other one as its third corner.
      const int third = k == 0 ? right : left;
      const Points a = minus<3>(of_first(pairs, third), lines.start_first);
      const Points b = minus<3>(of_second_shell(pairs, third), lines.start_second);
      const Wide own_first = lines.along_first - moved_along - moved_ * dot<3>(a, lines.across_second);
      const Wide target_second = lines.along_second + moved_ * dot<3>(a, lines.across_first);
      touching.of_first[k] = lines.near & both_within(beyond_ends<Wide>(own_first, kept) - lines.off_first,
                                                      beyond_ends<Wide>(target_second, lines.square) - lines.off_second);
      const Wide own_second = lines.along_second - moved_along - moved_ * dot<3>(b, lines.across_first);
      const Wide target_first = lines.along_first + moved_ * dot<3>(b, lines.across_second);
      touching.of_second[k] = lines.near & both_within(beyond_ends<Wide>(own_second, kept) - lines.off_second,
                                                       beyond_ends<Wide>(target_first, lines.square) - lines.off_first);
    }
  }

 private:
  // Of each shells one number, or four lanes.
  static SCREE_INLINE Wide numbers(const Fours& shells, const auto& number) {
    std::array<float, fours_of<Wide>> all;
    for (int i = 0; i < fours_of<Wide>; ++i) all[i] = number(shells[i]);
    Wide result;
    put_in_fours(all, result);
    return result;
  }
  static SCREE_INLINE Wide lanes(const Fours& shells, const auto& four) {
    std::array<Lanes, fours_of<Wide>> all;
    for (int i = 0; i < fours_of<Wide>; ++i) all[i] = four(shells[i]);
    return in_a_row<Wide>(all);
  }

  // Are both no more than 0? One comparison at the end takes less time than one of each, one after the other.
  static SCREE_INLINE unsigned both_within(const Wide& a, const Wide& b) { return bits(at_most(most(a, b), Wide{})); }

  // A vertex of the edge of the first of each pair, and of the second.
  SCREE_INLINE Points of_first(const SomePairs<Wide>& pairs, int corner) const {
    return picked(first_, pairs.vertices >> 4 * corner);
  }
  SCREE_INLINE Points of_second_shell(const SomePairs<Wide>& pairs, int corner) const {
    return picked(second_, pairs.vertices >> 4 * (of_second + corner));
  }

  SCREE_INLINE void cross_lines(const SomePairs<Wide>& pairs, Crossing<Wide>& lines) const {
    lines.start_first = of_first(pairs, start);
    lines.start_second = of_second_shell(pairs, start);
    const Points a = minus<3>(of_first(pairs, end), lines.start_first);
    const Points b = minus<3>(of_second_shell(pairs, end), lines.start_second);
    const Points between = minus<3>(lines.start_second, lines.start_first);
    const Points normal = cross(a, b);
    lines.square = dot<3>(normal, normal);
    lines.across_first = cross(normal, a);
    lines.across_second = cross(b, normal);
    lines.along_first = dot<3>(between, lines.across_second);
    lines.along_second = -dot<3>(between, lines.across_first);
    const Wide a_square = dot<3>(a, a), b_square = dot<3>(b, b), volume = dot<3>(between, normal);
    const Wide a_length = most_length<Wide>(a), b_length = most_length<Wide>(b), off = off_ * a_length * b_length;
    lines.off_first = off * b_length;
    lines.off_second = off * a_length;
    // Beside the place of the edges that of a semi-edge: its shift from the start times a vector across.
    const Wide aside = aside_ * most_length<Wide>(normal);
    constexpr float least_square = 0.99F * static_cast<float>(least_crossing_sine * least_crossing_sine);
    // The square of a sum x + y is at most 1.01 x^2 + 101 y^2.
    const Wide near_lines = 1.01F * distance_ * distance_ * lines.square + 101.0F * off * off;
    lines.near = both_within(most(volume * volume - near_lines, least_square * a_square * b_square - lines.square),
                             most(beyond_ends<Wide>(lines.along_first, lines.square) - (lines.off_first + aside * b_length),
                                  beyond_ends<Wide>(lines.along_second, lines.square) - (lines.off_second + aside * a_length)));
  }

  Wide distance_;  // between the lines of edges that touch, at most
  Wide off_;       // of a length, by rounding
  Wide aside_;     // the third corner of a face, no further from an edge than two radii, moves its semi-edges by no more
  float kept_;     // length of a semi-edge, over that of its edge
  float moved_;    // share of each corner of its face in a semi-spring
  Points first_, second_;  // vertices
};

// Goes through many pairs of shells with some of them at hand, one in each four of the lanes.
template <class Wide>
class Fours {
 public:
  SCREE_INLINE Fours(const std::vector<ShellEdges>& shells, float indentation, std::vector<TouchingEdges>& touching)
      : shells_(shells), kept_(1 - indentation), moved_(indentation / 3), touching_(touching) {
    // In every four some shells, even if there are fewer.
    if (!shells.empty()) asked_.fill(ShellsAsked(*shells[0].first, *shells[0].second));
    for (int i = 0; i < 6; ++i) vertices_[i] = vertices_of_edges[i];
    for (int i = 0; i < count_of<Wide>; ++i) {
      of_fours_[i] = static_cast<int>(static_cast<unsigned>(i / lane_count) * 0x44444444u);
    }
  }

  // Fills fours that have nothing left. False if there is nothing in any.
  SCREE_INLINE bool fill() {
    EdgePairs any = 0;
    for (int four = 0; four < count; ++four) {
      if (left_[four] == 0 && next_ != shells_.size()) {
        const auto& [first, second, edges] = shells_[next_];
        asked_[four] = ShellsAsked(*first, *second);
        left_[four] = edges;
        at_[four] = next_++;
      }
      any |= left_[four];
    }
    return any != 0;
  }

  [[nodiscard]] SCREE_INLINE EdgeBounds<Wide> bounds() const { return {asked_, kept_, moved_}; }

  // Takes some pairs from each four; lanes without one are of no matter.
  SCREE_INLINE void take(SomePairs<Wide>& pairs) {
    std::array<Lanes, count> numbers;
    pairs.asked = 0;
    for (int four = 0; four < count; ++four) {
      EdgePairs& left = left_[four];
      const int some = std::min(std::popcount(left), lane_count);
      pairs.asked |= ((1u << some) - 1) << lane_count * four;
      LaneMask of_four;
      for (int i = 0; i < lane_count; ++i) {
        of_four[i] = std::countr_zero(left);
        left &= left - 1;
      }
      numbers[four] = std::bit_cast<Lanes>(of_four);
    }
    const Wide all = in_a_row<Wide>(numbers);
    pairs.numbers = std::bit_cast<PlacesIn<Wide>>(all);
    const PlacesIn<Wide> first = pairs.numbers * 43 >> 8;  // over 6, for numbers up to 64
    const PlacesIn<Wide> second = pairs.numbers - 6 * first;
    pairs.vertices = shuffled(vertices_, first) + (shuffled(vertices_, second) << 4 * of_second) + of_fours_;
  }

  SCREE_INLINE void keep(const TouchingSome& found, const SomePairs<Wide>& pairs) {
    for (std::size_t k = 0; k < 2; ++k) {
      keep(found.of_first[k], pairs, [&](TouchingEdges& of) SCREE_INLINED -> EdgePairs& { return of.of_first[k]; });
      keep(found.of_second[k], pairs, [&](TouchingEdges& of) SCREE_INLINED -> EdgePairs& { return of.of_second[k]; });
    }
  }

 private:
  static constexpr int count = fours_of<Wide>;

  template <class SetOf>
  SCREE_INLINE void keep(unsigned found, const SomePairs<Wide>& pairs, const SetOf& set_of) {
    for (; found != 0; found &= found - 1) {
      const int i = std::countr_zero(found);
      set_of(touching_[at_[i / lane_count]]) |= EdgePairs{1} << pairs.numbers[i];
    }
  }

  const std::vector<ShellEdges>& shells_;
  float kept_, moved_;  // as in EdgeBounds
  std::vector<TouchingEdges>& touching_;
  std::size_t next_ = 0;
  std::array<std::size_t, count> at_{};
  std::array<EdgePairs, count> left_{};
  std::array<ShellsAsked, count> asked_{};
  PlacesIn<Wide> vertices_{};
  PlacesIn<Wide> of_fours_;  // added to each vertex of their lanes
};

}  // namespace

void find_touching_edges(const std::vector<ShellEdges>& shells, double indentation, std::vector<TouchingEdges>& touching) {
  touching.assign(shells.size(), {});
  widely([&](auto bytes) SCREE_INLINED {
    using Wide = LanesIn<bytes>;
    Fours<Wide> fours(shells, static_cast<float>(indentation), touching);
    while (fours.fill()) {
      SomePairs<Wide> some;
      fours.take(some);
      TouchingSome found;
      fours.bounds().may_touch(some, found);
      if (found.any()) fours.keep(found, some);
    }
  });
}

}  // namespace scree::contact
