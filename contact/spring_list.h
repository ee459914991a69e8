// What the semi-springs of some shells may touch: bounds in single precision, for all semi-springs of a shell at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/lanes_in.h"
#include "contact/shell.h"
#include "engine/base/written_later.h"

namespace scree::contact {

// The semi-spring of a shell in face f at vertex v has the number 4 f + v, whatever the dimension.
inline constexpr int springs_of_shell = lane_count * lane_count;

// Four bits for each bit of four.
inline constexpr std::array<std::uint16_t, 16> fourfold = [] {
  std::array<std::uint16_t, 16> sets{};
  for (unsigned faces = 0; faces < 16; ++faces) {
    for (unsigned f = 0; f < 4; ++f) sets[faces] = static_cast<std::uint16_t>(sets[faces] | (faces >> f & 1u) * 0xfu << 4 * f);
  }
  return sets;
}();

struct PossibleTouch {
  float bound;           // the semi-spring is no nearer, at least 0 [m]
  std::uint16_t spring;  // its number in the list
  std::uint8_t plane;    // of the target in its shell
  bool inside : 1;       // it is below the planes of all other faces of the target's element
  bool whole : 1;        // the target's block has no other element
  FaceId target;
};

// Semi-springs of some shells by `springs_of_shell` times the place of the shell in the list and their number there.
template <int dim>
class SpringList {
 public:
  static constexpr std::size_t most_shells = 16;
  static constexpr std::size_t most_springs = most_shells * springs_of_shell;

  explicit SpringList(double indentation)
      : kept_(static_cast<float>(1 - indentation)), moved_(static_cast<float>(indentation / dim)) {}

  void clear() {
    shells_.clear();
    limits_.fill(std::numeric_limits<float>::infinity());
  }

  // No more than `most_shells`.
  void add(const Shell<dim>& shell) {
    unsigned asked = 0;
    for (int f = 0; f <= dim; ++f) {
      if ((shell.open >> f & 1u) != 0) asked |= (all_vertices & ~(1u << f)) << lane_count * f;
    }
    shells_.push_back({&shell, asked});
  }

  [[nodiscard]] std::size_t shells() const { return shells_.size(); }
  [[nodiscard]] const Shell<dim>& shell_of(std::size_t spring) const { return *shells_[spring / springs_of_shell].shell; }
  // One bit each.
  [[nodiscard]] unsigned springs_of(std::size_t shell) const { return shells_[shell].asked; }

  // What is further from a semi-spring is not its target [m].
  [[nodiscard]] float limit_of(std::size_t spring) const { return limits_[spring]; }
  void lower_limit(std::size_t spring, double limit) { limits_[spring] = std::min(limits_[spring], static_cast<float>(limit)); }

  // What is further from a shell is no target of its semi-springs.
  [[nodiscard]] float limit_of_shell(std::size_t shell) const {
    float largest = 0;
    for (unsigned left = shells_[shell].asked; left != 0; left &= left - 1) {
      largest = std::max(largest, limits_[shell * springs_of_shell + static_cast<std::size_t>(std::countr_zero(left))]);
    }
    return largest;
  }

  // Appends what the semi-springs of a shell of the list may touch of another shell. Calls fetch(first face) for those that
  // they may touch at all. Either the vertex or the semi-spring must be within reach of the target face, and so of all planes
  // of its shell.
  template <class Wide, class Fetch>
  SCREE_INLINE void look_at(std::size_t shell, const Shell<dim>& other, VectorWrittenLater<PossibleTouch>& possible,
                            const Fetch& fetch) const {
    const Shell<dim>& owner = *shells_[shell].shell;
    const Way<dim> way(owner, other);
    View<Wide> view;
    view.heights(owner, other, way, kept_, moved_);
    const float* limits = limits_.data() + shell * springs_of_shell;
    unsigned near = 0;
    for (int part = 0; part < parts<Wide>; ++part) {
      Wide limit;
      __builtin_memcpy(&limit, limits + part * count_of<Wide>, sizeof limit);
      near |= bits(at_most(least(view.vertex_beyond, view.spring_beyond[part]), view.reach) &
                   at_most(view.spring_beyond[part] - way.rounding, limit))
              << part * count_of<Wide>;
    }
    near &= shells_[shell].asked;
    if (near == 0) return;
    fetch(other.first);
    list(view, other, shell, near, possible);
  }

 private:
  static constexpr unsigned all_vertices = (2u << dim) - 1;

  // In so many vectors the semi-springs of a shell are worked on.
  template <class Wide>
  static constexpr int parts = springs_of_shell / count_of<Wide>;

  struct Own {
    const Shell<dim>* shell;
    unsigned asked;  // its semi-springs, one bit each
  };

  // Of four lanes, repeated or not, the one of the face of each semi-spring.
  template <int part>
  static SCREE_INLINE WideLanes of_faces(const WideLanes& a) {
    constexpr int first = 2 * part, second = first + 1;
    return __builtin_shufflevector(a, a, first, first, first, first, second, second, second, second);
  }
  template <int>
  static SCREE_INLINE WidestLanes of_faces(const WidestLanes& a) {
    return __builtin_shufflevector(a, a, 0, 0, 0, 0, 5, 5, 5, 5, 10, 10, 10, 10, 15, 15, 15, 15);
  }

  // Another shell as seen from the owner's. Lanes are semi-springs; of vertices all fours are the same.
  template <class Wide>
  struct View {
    std::array<Wide, dim + 1> vertices;  // heights above each plane
    std::array<std::array<Wide, parts<Wide>>, dim + 1> springs;
    // How far they are beyond any plane.
    Wide vertex_beyond{};
    std::array<Wide, parts<Wide>> spring_beyond{};
    float rounding;  // of all of these
    Wide reach;      // the owner's, and this

    SCREE_INLINE void heights(const Shell<dim>& owner, const Shell<dim>& other, const Way<dim>& way, float kept, float moved) {
      rounding = way.rounding;
      reach = repeated<Wide>(owner.reach + rounding);
      std::array<Wide, dim> at;
      Lanes of_centre = -other.offsets;
      for (int i = 0; i < dim; ++i) {
        at[i] = repeated<Wide>(owner.at[i] - way.axes[i]);
        of_centre -= other.normals[i] * way.axes[i];
      }
      // Three corners of a face move its semi-springs towards its centre: all vertices but one.
      const Lanes sum = moved * (dim + 1) * of_centre;
      for (int t = 0; t <= dim; ++t) {
        Wide height = other.normals[0][t] * at[0] - other.offsets[t];
        for (int i = 1; i < dim; ++i) height += other.normals[i][t] * at[i];
        vertices[t] = height;
        vertex_beyond = most(vertex_beyond, height);
        const Wide moves = moved * height;
        const Wide vertex = kept * height + sum[t];
        for_each_constant<parts<Wide>>([&](auto part) SCREE_INLINED {
          springs[t][part] = vertex - of_faces<part>(moves);
          spring_beyond[part] = most(spring_beyond[part], springs[t][part]);
        });
      }
    }
  };

  // Of each plane of the other the owner's faces that are opposed to it, four bits each.
  template <class Wide>
  SCREE_INLINE unsigned opposed(const Shell<dim>& owner, const Shell<dim>& other) const {
    unsigned planes = 0;
    for_each_constant<parts<Wide>>([&](auto part) SCREE_INLINED {
      Wide cosines{};
      for (int i = 0; i < dim; ++i) {
        cosines += repeated<Wide>(owner.normals[i]) * of_faces<part>(repeated<Wide>(other.normals[i]));
      }
      constexpr float rounding = 1e-6F;
      planes |= bits(below(cosines, repeated<Wide>(rounding))) << part * count_of<Wide>;
    });
    return planes;
  }

  // The semi-springs that are not below each plane.
  template <class Wide>
  static SCREE_INLINE std::array<unsigned, dim + 1> not_below_planes(const View<Wide>& view) {
    std::array<unsigned, dim + 1> springs{};
    for (int t = 0; t <= dim; ++t) {
      for (int part = 0; part < parts<Wide>; ++part) {
        springs[t] |= bits(at_most(repeated<Wide>(-view.rounding), view.springs[t][part])) << part * count_of<Wide>;
      }
    }
    return springs;
  }

  // The semi-springs that may be within reach of face t of the other shell, and bounds of how far they all are from it.
  template <class Wide>
  static SCREE_INLINE unsigned within_reach(const View<Wide>& view, int t, std::array<float, springs_of_shell>& bounds) {
    const Wide vertex_away = most(absolute(view.vertices[t]), view.vertex_beyond);
    unsigned found = 0;
    for (int part = 0; part < parts<Wide>; ++part) {
      const Wide spring_away = most(absolute(view.springs[t][part]), view.spring_beyond[part]);
      found |= bits(at_most(least(vertex_away, spring_away), view.reach)) << part * count_of<Wide>;
      const Wide bound = most(spring_away - view.rounding, Wide{});
      __builtin_memcpy(bounds.data() + part * count_of<Wide>, &bound, sizeof bound);
    }
    return found;
  }

  template <class Wide>
  SCREE_INLINE void list(const View<Wide>& view, const Shell<dim>& other, std::size_t shell, unsigned near,
                         VectorWrittenLater<PossibleTouch>& possible) const {
    const unsigned faces_opposed = opposed<Wide>(*shells_[shell].shell, other);
    const std::array<unsigned, dim + 1> not_below = not_below_planes(view);
    const std::size_t listed = possible.size();
    possible.resize(listed + (dim + 1) * springs_of_shell);
    PossibleTouch* next = possible.data() + listed;
    for_each_constant<dim + 1>([&](auto t) SCREE_INLINED {
      if ((other.faces >> t & 1u) == 0) return;
      std::array<float, springs_of_shell> bounds;
      unsigned found = within_reach<Wide>(view, t, bounds);
      found &= near & fourfold[faces_opposed >> 4 * t & 0xfu];
      if (found == 0) return;
      unsigned outside = 0;
      for (int plane = 0; plane <= dim; ++plane) outside |= plane == t ? 0u : not_below[plane];
      const FaceId face = other.face(t);
      for (; found != 0; found &= found - 1) {
        const int spring = std::countr_zero(found);
        *next++ = {bounds[spring],
                   static_cast<std::uint16_t>(shell * springs_of_shell + static_cast<std::size_t>(spring)),
                   static_cast<std::uint8_t>(t),
                   (outside >> spring & 1u) == 0,
                   other.whole,
                   face};
      }
    });
    possible.resize(static_cast<std::size_t>(next - possible.data()));
  }

  float kept_, moved_;  // shares of the vertex and of each corner of its face in a semi-spring
  std::vector<Own> shells_;
  alignas(sizeof(WidestLanes)) std::array<float, most_springs> limits_;
};

}  // namespace scree::contact
