#include "contact/candidates.h"

#include <cmath>

#include "contact/face_bounds.h"
#include "contact/segment.h"
#include "contact/touch.h"

namespace scree::contact {

namespace {

// What touch_face and touch_edge are asked only after cheap bounds have dismissed nearly all pairs.
template <int dim>
class PairSearch {
 public:
  PairSearch(const Surface<dim>& surface, const ContactOptions& options)
      : surface_(surface), options_(options), bounds_(face_bounds(surface, options.tolerance)), grid_(bounds_) {
    corners_.reserve(surface.faces.size());
    for (const FaceId face : surface.faces.ids()) corners_.push_back(corners_of(surface, face));
  }

  [[nodiscard]] Candidates run() {
    auto scratch = grid_.make_scratch();
    for (const FaceId face : surface_.faces.ids()) {
      grid_.find(face, scratch);
      for (const FaceId other : scratch.found) add_pair(face, other);
    }
    return std::move(candidates_);
  }

 private:
  using Heights = std::array<double, dim>;

  void add_pair(FaceId a, FaceId b) {
    const double reach = std::max(bounds_[a].reach, bounds_[b].reach);
    const Heights a_above_b = heights_above<dim>(bounds_[b], corners_[a]);
    if (all_beyond(a_above_b, reach)) return;
    const Heights b_above_a = heights_above<dim>(bounds_[a], corners_[b]);
    if (all_beyond(b_above_a, reach)) return;
    if (bounds_[a].normal.dot(bounds_[b].normal) < 0) {
      add_springs(a, b, a_above_b);
      add_springs(b, a, b_above_a);
    }
    if constexpr (dim == 3) {
      add_edges(a, b, b_above_a);
      add_edges(b, a, a_above_b);
    }
  }

  void add_springs(FaceId owner, FaceId target, const Heights& heights) {
    const double reach = bounds_[owner].reach;
    double mean = 0;
    for (const double height : heights) mean += height / dim;
    for (int corner = 0; corner < dim; ++corner) {
      const double vertex = heights[corner];
      const double spring = vertex + options_.indentation * (mean - vertex);
      if (std::abs(vertex) > margin * reach && std::abs(spring) > margin * reach) continue;
      const auto touch = touch_face(surface_, options_, owner, corner, target);
      if (!touch) continue;
      const auto index = static_cast<std::uint32_t>(owner.index() * dim + corner);
      candidates_.springs.push_back({index, target, std::abs(touch->gap), touch->facing});
    }
  }

  // An edge is searched with the first of its two faces. `heights` are the target's corners above the owner's plane.
  void add_edges(FaceId owner, FaceId target, const Heights& heights) {
    const FaceBounds<dim>& bounds = bounds_[owner];
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3;
      if (all_beyond<2>({heights[i], heights[next]}, margin * bounds.reach)) continue;
      const EdgeId edge = surface_.face_edges[target][i];
      if (surface_.edges[edge].faces[0] != target) continue;
      const Point<3>& start = corners_[target][i];
      const Point<3>& end = corners_[target][next];
      if ((start.cwiseMin(end).array() > bounds.box.max().array()).any()) continue;
      if ((start.cwiseMax(end).array() < bounds.box.min().array()).any()) continue;
      add_edge(owner, edge, start, end);
    }
  }

  void add_edge(FaceId owner, EdgeId edge, const Point<3>& start, const Point<3>& end) {
    const Corners<3>& own = corners_[owner];
    const Point<3> centre = (own[0] + own[1] + own[2]) / 3;
    Corners<3> springs;
    for (int i = 0; i < 3; ++i) springs[i] = own[i] + options_.indentation * (centre - own[i]);
    for (int side = 0; side < 3; ++side) {
      // The edge that the semi-edge stands for is no further from it than this, and may touch in its place.
      const double shift = (springs[side] - own[side]).norm();
      const double distance = margin * (bounds_[owner].reach + shift);
      if (!may_cross(springs[side], springs[(side + 1) % 3], start, end, distance)) continue;
      const auto touch = touch_edge(surface_, options_, owner, side, edge);
      if (!touch) continue;
      const auto index = static_cast<std::uint32_t>(owner.index() * 3 + side);
      candidates_.edges.push_back({index, edge, std::abs(touch->gap), std::abs(touch->along - 0.5)});
    }
  }

  static constexpr double margin = 1 + 1e-9;  // so that rounding dismisses nothing that touches

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  Table<FaceId, FaceBounds<dim>> bounds_;
  Table<FaceId, Corners<dim>> corners_;
  FaceGrid<dim> grid_;
  Candidates candidates_;
};

}  // namespace

template <int dim>
Candidates find_candidates(const Surface<dim>& surface, const ContactOptions& options) {
  return PairSearch<dim>(surface, options).run();
}

template Candidates find_candidates<2>(const Surface<2>&, const ContactOptions&);
template Candidates find_candidates<3>(const Surface<3>&, const ContactOptions&);

}  // namespace scree::contact
