#include "contact/spring_search.h"

#include <array>
#include <cmath>

#include "contact/choice.h"
#include "contact/touch.h"
#include "engine/base/chunks.h"

namespace scree::contact {

namespace {

constexpr double margin = 1 + 1e-9;  // so that rounding dismisses nothing that touches

// Is neither a vertex nor any semi-spring beside it further than reach beyond a plane of the other shell?
template <int dim>
bool may_reach(const Shell<dim>& owner, const Shell<dim>& other, const Heights<dim>& heights, int vertex, double indentation) {
  const double reach = margin * owner.reach;
  for (int t = 0; t < other.faces; ++t) {
    const double height = heights[t][vertex];
    if (height <= reach) continue;
    const double lowest = *std::min_element(heights[t].begin(), heights[t].end());
    if (height + indentation * (lowest - height) > reach) return false;
  }
  return true;
}

template <int dim>
bool any_may_reach(const Shell<dim>& owner, const Shell<dim>& other, const Heights<dim>& heights, double indentation) {
  for (int v = 0; v <= dim; ++v) {
    if (may_reach(owner, other, heights, v, indentation)) return true;
  }
  return false;
}

// The semi-springs of one shell after the other.
template <int dim>
class ShellSprings {
 public:
  ShellSprings(const Surface<dim>& surface, const ContactOptions& options) : surface_(surface), options_(options) {}

  void begin() {
    for (auto& places : possible_) places.clear();
  }

  void look_at(const Shell<dim>& owner, const Shell<dim>& other) {
    const Heights<dim> heights = heights_above(other, owner);
    std::array<bool, dim + 1> near;
    for (int v = 0; v <= dim; ++v) near[v] = may_reach(owner, other, heights, v, options_.indentation);
    for (int f = 0; f < owner.faces; ++f) {
      for (int c = 0; c < dim; ++c) {
        if (near[owner.corners[f][c]]) look_at_spring(owner, other, heights, f, c);
      }
    }
  }

  // Of the semi-spring of a corner of a face of the shell. A face whose lower bound is above the least distance found has no
  // part in the choice.
  FaceId target_of(const Shell<dim>& owner, int face, int corner) {
    auto& places = possible_[face * dim + corner];
    if (places.empty()) return {};
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.bound < b.bound || (a.bound == b.bound && a.target < b.target); });
    candidates_.clear();
    const FaceId own = owner.face(face);
    const double equal = equal_distance * surface_.lengths[own];
    double least = std::numeric_limits<double>::infinity();
    for (const Place& place : places) {
      if (place.bound > least + 2 * equal) break;
      const auto touch = touch_face(surface_, options_, own, corner, place.target);
      if (!touch) continue;
      candidates_.push_back({place.target, std::abs(touch->gap), -touch->facing});
      least = std::min(least, candidates_.back().distance);
    }
    return choose(candidates_, equal);
  }

 private:
  struct Place {
    double bound;  // the semi-spring is no nearer [m]
    FaceId target;
  };

  // Either the vertex or the semi-spring must be within reach of the target face, and so of all planes of its shell.
  void look_at_spring(const Shell<dim>& owner, const Shell<dim>& other, const Heights<dim>& heights, int face, int corner) {
    const auto& corners = owner.corners[face];
    const int vertex = corners[corner];
    const double reach = margin * owner.reach;
    std::array<double, dim + 1> springs;
    double vertex_beyond = 0, spring_beyond = 0;
    for (int t = 0; t < other.faces; ++t) {
      double mean = 0;
      for (const int c : corners) mean += heights[t][c] / dim;
      springs[t] = heights[t][vertex] + options_.indentation * (mean - heights[t][vertex]);
      vertex_beyond = std::max(vertex_beyond, heights[t][vertex]);
      spring_beyond = std::max(spring_beyond, springs[t]);
    }
    if (vertex_beyond > reach && spring_beyond > reach) return;
    for (int t = 0; t < other.faces; ++t) {
      if (owner.normals[face].dot(other.normals[t]) >= 0) continue;
      const double vertex_away = std::max(vertex_beyond, std::abs(heights[t][vertex]));
      const double spring_away = std::max(spring_beyond, std::abs(springs[t]));
      if (vertex_away > reach && spring_away > reach) continue;
      possible_[face * dim + corner].push_back({spring_away, other.face(t)});
    }
  }

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  std::array<std::vector<Place>, (dim + 1) * dim> possible_;  // of each semi-spring of the shell
  std::vector<Candidate<FaceId>> candidates_;
};

}  // namespace

template <int dim>
SpringSearch<dim>::SpringSearch(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table)
    : surface_(surface), options_(options), table_(table), near_(chunk_count(table.shells.size())) {}

template <int dim>
void SpringSearch<dim>::look_at(std::size_t chunk, const ShellPair<dim>& pair) {
  if (any_may_reach(pair.first, pair.second, pair.above_second, options_.indentation)) {
    near_[chunk].emplace_back(pair.first_place, pair.second_place);
  }
  if (any_may_reach(pair.second, pair.first, pair.above_first, options_.indentation)) {
    near_[chunk].emplace_back(pair.second_place, pair.first_place);
  }
}

// Sorts the others by shell.
template <int dim>
void SpringSearch<dim>::link() {
  starts_.assign(table_.shells.size() + 1, 0);
  for (const auto& part : near_) {
    for (const auto& [own, other] : part) ++starts_[own + 1];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  others_.resize(starts_.back());
  for (const auto& part : near_) {
    for (const auto& [own, other] : part) others_[starts_[own]++] = other;
  }
  for (std::size_t i = starts_.size() - 1; i > 0; --i) starts_[i] = starts_[i - 1];
  starts_[0] = 0;
  near_ = {};
}

template <int dim>
std::vector<FaceId> SpringSearch<dim>::targets() {
  link();
  std::vector<FaceId> targets(surface_.faces.size() * dim);
  for_chunks(table_.shells.size(), [&](Chunk chunk) {
    ShellSprings<dim> springs(surface_, options_);
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const Shell<dim>& owner = table_.shells[i];
      springs.begin();
      for (std::size_t n = starts_[i]; n < starts_[i + 1]; ++n) springs.look_at(owner, table_.shells[others_[n]]);
      for (int f = 0; f < owner.faces; ++f) {
        for (int c = 0; c < dim; ++c) targets[owner.face(f).index() * dim + c] = springs.target_of(owner, f, c);
      }
    }
  });
  return targets;
}

template class SpringSearch<2>;
template class SpringSearch<3>;

}  // namespace scree::contact
