// What the semi-springs of some shells may touch: bounds in single precision, for all semi-springs of a shell at once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "contact/shell.h"
#include "contact/wide_lanes.h"

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
  bool inside;           // it is below the planes of all other faces of the target's element
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
      if ((shell.faces >> f & 1u) != 0) asked |= (all_vertices & ~(1u << f)) << lane_count * f;
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
  template <class Fetch>
  SCREE_INLINE void look_at(std::size_t shell, const Shell<dim>& other, std::vector<PossibleTouch>& possible,
                            const Fetch& fetch) const {
    const Shell<dim>& owner = *shells_[shell].shell;
    const Way<dim> way(owner, other);
    View view;
    view.heights(owner, other, way, kept_, moved_);
    const float* limits = limits_.data() + shell * springs_of_shell;
    const WideLanes reach = joined(owner.reach + way.rounding, owner.reach + way.rounding);
    unsigned near = 0;
    for (int half = 0; half < 2; ++half) {
      WideLanes limit;
      __builtin_memcpy(&limit, limits + half * wide_count, sizeof limit);
      const WideMask may_touch = least(view.vertex_beyond, view.spring_beyond[half]) <= reach;
      near |= bits(may_touch & (view.spring_beyond[half] - way.rounding <= limit)) << wide_count * half;
    }
    near &= shells_[shell].asked;
    if (near == 0) return;
    fetch(other.first);
    list(view, owner, other, shell, near, reach, way.rounding, possible);
  }

 private:
  static constexpr unsigned all_vertices = (2u << dim) - 1;

  struct Own {
    const Shell<dim>* shell;
    unsigned asked;  // its semi-springs, one bit each
  };

  // Another shell as seen from the owner's. Lanes are semi-springs, those of faces 0 and 1 and those of 2 and 3; of vertices
  // both halves are the same.
  struct View {
    std::array<WideLanes, dim + 1> vertices;  // heights above each plane
    std::array<std::array<WideLanes, 2>, dim + 1> springs;
    // How far they are beyond any plane.
    WideLanes vertex_beyond{};
    std::array<WideLanes, 2> spring_beyond{};

    SCREE_INLINE void heights(const Shell<dim>& owner, const Shell<dim>& other, const Way<dim>& way, float kept, float moved) {
      std::array<WideLanes, dim> at;
      Lanes of_centre = -other.offsets;
      for (int i = 0; i < dim; ++i) {
        const Lanes axis = owner.at[i] - way.axes[i];
        at[i] = joined(axis, axis);
        of_centre -= other.normals[i] * way.axes[i];
      }
      // Three corners of a face move its semi-springs towards its centre: all vertices but one.
      const Lanes sum = moved * (dim + 1) * of_centre;
      for (int t = 0; t <= dim; ++t) {
        WideLanes height = joined(-other.offsets[t], -other.offsets[t]);
        for (int i = 0; i < dim; ++i) height += other.normals[i][t] * at[i];
        vertices[t] = height;
        vertex_beyond = most(vertex_beyond, height);
        const WideLanes moves = moved * height;
        const WideLanes vertex = kept * height + sum[t];
        springs[t][0] = vertex - __builtin_shufflevector(moves, moves, 0, 0, 0, 0, 5, 5, 5, 5);
        springs[t][1] = vertex - __builtin_shufflevector(moves, moves, 2, 2, 2, 2, 7, 7, 7, 7);
        for (int half = 0; half < 2; ++half) spring_beyond[half] = most(spring_beyond[half], springs[t][half]);
      }
    }
  };

  // Of each plane of the other the owner's faces that are opposed to it, four bits each.
  SCREE_INLINE unsigned opposed(const Shell<dim>& owner, const Shell<dim>& other) const {
    WideLanes low{}, high{};
    for (int i = 0; i < dim; ++i) {
      const WideLanes own = joined(owner.normals[i], owner.normals[i]);
      low += own * __builtin_shufflevector(other.normals[i], other.normals[i], 0, 0, 0, 0, 1, 1, 1, 1);
      high += own * __builtin_shufflevector(other.normals[i], other.normals[i], 2, 2, 2, 2, 3, 3, 3, 3);
    }
    constexpr float rounding = 1e-6F;
    const WideLanes least_cosine = joined(rounding, rounding);
    return bits(low < least_cosine) | bits(high < least_cosine) << wide_count;
  }

  SCREE_INLINE void list(const View& view, const Shell<dim>& owner, const Shell<dim>& other, std::size_t shell, unsigned near,
                         const WideLanes& reach, float rounding, std::vector<PossibleTouch>& possible) const {
    const unsigned faces_opposed = opposed(owner, other);
    std::array<unsigned, dim + 1> not_below;  // semi-springs, of each plane
    for (int t = 0; t <= dim; ++t) {
      const auto& [first, second] = view.springs[t];
      not_below[t] = bits(first >= -joined(rounding, rounding)) | bits(second >= -joined(rounding, rounding)) << wide_count;
    }
    for (int t = 0; t <= dim; ++t) {
      if ((other.faces >> t & 1u) == 0) continue;
      const WideLanes vertex_away = most(absolute(view.vertices[t]), view.vertex_beyond);
      std::array<float, springs_of_shell> bounds;
      unsigned found = 0;
      for (int half = 0; half < 2; ++half) {
        const WideLanes spring_away = most(absolute(view.springs[t][half]), view.spring_beyond[half]);
        found |= bits(least(vertex_away, spring_away) <= reach) << wide_count * half;
        const WideLanes bound = most(spring_away - rounding, WideLanes{});
        __builtin_memcpy(bounds.data() + half * wide_count, &bound, sizeof bound);
      }
      found &= near & fourfold[faces_opposed >> 4 * t & 0xfu];
      if (found == 0) continue;
      unsigned outside = 0;
      for (int plane = 0; plane <= dim; ++plane) outside |= plane == t ? 0u : not_below[plane];
      const FaceId face = other.face(t);
      for (; found != 0; found &= found - 1) {
        const int spring = std::countr_zero(found);
        possible.push_back({bounds[spring],
                            static_cast<std::uint16_t>(shell * springs_of_shell + static_cast<std::size_t>(spring)),
                            (outside >> spring & 1u) == 0, face});
      }
    }
  }

  float kept_, moved_;  // shares of the vertex and of each corner of its face in a semi-spring
  std::vector<Own> shells_;
  alignas(WideLanes) std::array<float, most_springs> limits_;
};

}  // namespace scree::contact
