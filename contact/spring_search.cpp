#include "contact/spring_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "contact/choice.h"
#include "contact/touch.h"
#include "engine/base/chunks.h"
#include "engine/base/threads.h"

namespace scree::contact {

namespace {

// The semi-springs of one shell after the other. That of face f at vertex v has the number 4 f + v, whatever the dimension.
template <int dim>
class ShellSprings {
 public:
  ShellSprings(const Surface<dim>& surface, const ContactOptions& options)
      : surface_(surface),
        options_(options),
        kept_(static_cast<float>(1 - options.indentation)),
        moved_(static_cast<float>(options.indentation / dim)) {}

  void begin(const Shell<dim>& owner) {
    owner_ = &owner;
    for (auto& touched : touched_) touched.clear();
    for (Lanes& limit : limits_) limit = all_lanes(std::numeric_limits<float>::infinity());
    asked_ = 0;
    for (int f = 0; f <= dim; ++f) {
      if ((owner.faces >> f & 1u) != 0) asked_ |= (all_vertices & ~(1u << f)) << lane_count * f;
    }
  }

  // Either the vertex or the semi-spring must be within reach of the target face, and so of all planes of its shell.
  void look_at(const Shell<dim>& other) {
    const Way<dim> way(*owner_, other);
    View view{other, way.rounding, heights_above<dim>(other, vertices_back(*owner_, way)), {}, {}};
    const auto& heights = view.heights;
    view.sum = heights[0];
    for (int v = 1; v <= dim; ++v) view.sum += heights[v];
    // The same by planes, with a lane for every vertex: how far each vertex and each semi-spring is beyond any of them.
    const auto by_plane = transposed(heights[0], heights[1], heights[2], heights[dim == 2 ? 0 : 3]);
    Lanes vertex_beyond{};
    for (const Lanes& above : by_plane) vertex_beyond = most(vertex_beyond, above);
    std::array<Lanes, dim + 1> spring_beyond{};  // of each face
    for (int t = 0; t <= dim; ++t) {
      const Lanes kept = kept_ * by_plane[t];
      const Lanes centres = moved_ * (view.sum[t] - by_plane[t]);
      for (int f = 0; f <= dim; ++f) spring_beyond[f] = most(spring_beyond[f], kept + centres[f]);
    }
    unsigned near = 0;
    for (int f = 0; f <= dim; ++f) {
      const LaneMask may_touch = least(vertex_beyond, spring_beyond[f]) <= owner_->reach + way.rounding;
      const LaneMask may_win = spring_beyond[f] - way.rounding <= limits_[f];
      near |= bits(may_touch & may_win) << lane_count * f;
    }
    near &= asked_;
    if (near == 0) return;
    fetch(other.first);
    for (int t = 0; t <= dim; ++t) view.faces[t] = other.face(t);
    constexpr std::size_t most = spring_count * (dim + 1);
    if (possible_.size() < count_ + most) possible_.resize(2 * count_ + most);
    for (; near != 0; near &= near - 1) {
      const int spring = std::countr_zero(near), v = spring % lane_count;
      look_at_spring(view, spring, vertex_beyond[v], spring_beyond[spring / lane_count][v]);
    }
  }

  // What is further from the owner is no semi-spring's target, as far as is known now.
  [[nodiscard]] float limit() const {
    float largest = 0;
    for (unsigned left = asked_; left != 0; left &= left - 1) largest = std::max(largest, limit_of(std::countr_zero(left)));
    return largest;
  }

  // Touches what the semi-springs may take as their targets. No semi-spring is nearer to a face than its bound: once one is
  // touched, those that cannot beat it need no look.
  void touch_possible() {
    while (count_ > 0) {
      const auto nearest = nearest_of_each();
      for (unsigned left = asked_; left != 0; left &= left - 1) {
        const std::size_t i = nearest[std::countr_zero(left)];
        if (i < count_) fetch_corners(possible_[i].target);
      }
      for (unsigned left = asked_; left != 0; left &= left - 1) {
        const int spring = std::countr_zero(left);
        if (nearest[spring] < count_) touch(spring, possible_[nearest[spring]].target);
      }
      std::size_t kept = 0;
      for (std::size_t i = 0; i < count_; ++i) {
        const Possible possible = possible_[i];
        possible_[kept] = possible;
        kept += possible.bound <= limit_of(possible.spring) && i != nearest[possible.spring] ? 1 : 0;
      }
      count_ = kept;
    }
  }

  // Adds what the semi-spring of face f at vertex v, with this number in the surface, takes as its target.
  void take_target(int f, int v, std::size_t spring, std::vector<SpringTouch<dim>>& touches) {
    const Touched* best = best_of(touched_[lane_count * f + v], equal_distance * surface_.lengths[owner_->face(f)]);
    if (best == nullptr) return;
    touches.push_back({static_cast<std::uint32_t>(spring), best->target, best->touch.gap, best->touch.on_target});
  }

 private:
  static constexpr unsigned all_vertices = (2u << dim) - 1;
  static constexpr std::size_t spring_count = (dim + 1) * lane_count;

  struct Possible {
    float bound;  // the semi-spring is no nearer [m]
    std::int32_t spring;
    FaceId target;
  };
  struct Touched : Candidate<FaceId> {
    PointTouch<dim> touch;
  };

  // Another shell as seen from the owner's.
  struct View {
    const Shell<dim>& other;
    float rounding;
    Heights<dim> heights;  // of the owner's vertices above the other's planes
    Lanes sum;             // of them all
    std::array<FaceId, dim + 1> faces;
  };

  [[nodiscard]] float limit_of(int spring) const { return limits_[spring / lane_count][spring % lane_count]; }

  // Faces that are near are listed without a branch for each, which no one could foretell: a face that is not is written over.
  void look_at_spring(const View& view, int spring, float vertex_beyond, float spring_beyond) {
    const auto& [other, rounding, heights, sum, faces] = view;
    const int f = spring / lane_count, v = spring % lane_count;
    Lanes cosine = owner_->normals[0][f] * other.normals[0];
    for (int i = 1; i < dim; ++i) cosine += owner_->normals[i][f] * other.normals[i];
    const Lanes at = kept_ * heights[v] + moved_ * (sum - heights[f]);
    const Lanes vertex_away = most(absolute(heights[v]), all_lanes(vertex_beyond));
    const Lanes spring_away = most(absolute(at), all_lanes(spring_beyond));
    constexpr float cosine_rounding = 1e-6F;
    const LaneMask near = (least(vertex_away, spring_away) <= owner_->reach + rounding) & (cosine < cosine_rounding);
    const unsigned found = bits(near) & other.faces;
    const Lanes bounds = spring_away - rounding;
    Possible* next = possible_.data() + count_;
    for (int t = 0; t <= dim; ++t) {
      *next = {bounds[t], spring, faces[t]};
      next += found >> t & 1u;
    }
    count_ = static_cast<std::size_t>(next - possible_.data());
  }

  // What touch_face will ask of a target lies here and there in memory. It is asked for all targets of a shell at once, before
  // the first is touched, so that they need not be waited for one by one: first the faces, then what they refer to.
  void fetch(FaceId face) const {
    __builtin_prefetch(&surface_.faces[face]);
    __builtin_prefetch(&surface_.normals[face]);
    if constexpr (dim == 3) __builtin_prefetch(&surface_.face_edges[face]);
  }
  void fetch_corners(FaceId face) const {
    __builtin_prefetch(&surface_.mesh.nodes[surface_.faces[face].nodes[0]]);
    if constexpr (dim == 3) __builtin_prefetch(&surface_.edges[surface_.face_edges[face][0]]);
  }

  // Of each semi-spring the place of its nearest possible target, or the number of all.
  [[nodiscard]] std::array<std::size_t, spring_count> nearest_of_each() const {
    std::array<std::size_t, spring_count> nearest;
    std::array<float, spring_count> bounds;
    nearest.fill(count_);
    bounds.fill(std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < count_; ++i) {
      const auto& [bound, spring, target] = possible_[i];
      const bool nearer = bound < bounds[spring];
      nearest[spring] = nearer ? i : nearest[spring];
      bounds[spring] = nearer ? bound : bounds[spring];
    }
    return nearest;
  }

  void touch(int spring, FaceId target) {
    const int f = spring / lane_count, v = spring % lane_count;
    const FaceId own = owner_->face(f);
    const auto& corners = mesh::opposite_corners<dim>[f];
    const auto corner = static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    const auto touch = touch_face(surface_, options_, own, corner, target);
    if (!touch) return;
    const double distance = std::abs(touch->gap);
    touched_[spring].push_back({{target, distance, -touch->facing}, *touch});
    constexpr double rounding = 1 + 1e-6;
    const double limit = rounding * (distance + 2 * equal_distance * surface_.lengths[own]);
    limits_[f][v] = std::min(limits_[f][v], static_cast<float>(limit));
  }

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  float kept_, moved_;  // shares of the vertex and of each corner of its face in a semi-spring
  const Shell<dim>* owner_ = nullptr;
  unsigned asked_ = 0;              // its semi-springs, one bit each
  std::vector<Possible> possible_;  // the first count_
  std::size_t count_ = 0;
  std::array<std::vector<Touched>, spring_count> touched_;  // of each semi-spring
  std::array<Lanes, dim + 1> limits_;  // what is further from a semi-spring is not its target, of each face and vertex [m]
};

}  // namespace

template <int dim>
SpringSearch<dim>::SpringSearch(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table,
                                std::vector<std::vector<NearSprings>> near)
    : surface_(surface), options_(options), table_(table) {
  link(std::move(near));
}

// Sorts the others by shell.
template <int dim>
void SpringSearch<dim>::link(std::vector<std::vector<NearSprings>>&& near) {
  const auto for_all = [&](const auto& enter) {
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < near.size(); ++i) {
      for (const auto& [own, other] : near[i]) enter(own, other);
    }
  };
  // Each start is counted two places on and moves one on while it is filled in.
  starts_.assign(table_.shells.size() + 2, 0);
  const bool alone = threads_in_use() == 1;
  const auto next = [&](std::uint32_t shell) {
    if (alone) return starts_[shell]++;  // an atomic sum takes several times as long
    return std::atomic_ref(starts_[shell]).fetch_add(1, std::memory_order_relaxed);
  };
  for_all([&](std::uint32_t own, NearShell) { next(own + 2); });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  others_.resize(starts_.back());
  for_all([&](std::uint32_t own, NearShell other) { others_[next(own + 1)] = other; });
}

template <int dim>
std::vector<std::vector<SpringTouch<dim>>> SpringSearch<dim>::touches() {
  std::vector<std::vector<SpringTouch<dim>>> touches(chunk_count(table_.shells.size()));
  for_chunks(table_.shells.size(), [&](Chunk chunk) {
    ShellSprings<dim> springs(surface_, options_);
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const Shell<dim>& owner = table_.shells[i];
      springs.begin(owner);
      for (const unsigned close : {1u, 0u}) {
        const float limit = springs.limit();
        for (std::size_t n = starts_[i]; n < starts_[i + 1]; ++n) {
          __builtin_prefetch(&table_.shells[others_[std::min<std::size_t>(n + 3, starts_[i + 1] - 1)].place]);
          if (others_[n].close == close && others_[n].bound <= limit) springs.look_at(table_.shells[others_[n].place]);
        }
        springs.touch_possible();
      }
      for (int f = 0; f <= dim; ++f) {
        if ((owner.faces >> f & 1u) == 0) continue;
        std::size_t spring = owner.face(f).index() * dim;
        for (const int v : mesh::opposite_corners<dim>[f]) springs.take_target(f, v, spring++, touches[chunk.number]);
      }
    }
  });
  return touches;
}

template class SpringSearch<2>;
template class SpringSearch<3>;

}  // namespace scree::contact
