#include "contact/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/face_grid.h"
#include "contact/touch.h"

namespace scree::contact {

namespace {

template <int dim>
Table<FaceId, FaceBounds<dim>> bounds_of(const Surface<dim>& surface, const ContactOptions& options) {
  Table<FaceId, FaceBounds<dim>> all;
  all.reserve(surface.faces.size());
  for (const FaceId f : surface.faces.ids()) {
    FaceBounds<dim> bounds;
    const Corners<dim> corners = corners_of(surface, f);
    for (const auto& corner : corners) bounds.box.extend(corner);
    bounds.reach = options.tolerance * surface.lengths[f];
    bounds.box.min().array() -= bounds.reach;
    bounds.box.max().array() += bounds.reach;
    bounds.normal = surface.normals[f];
    bounds.offset = bounds.normal.dot(corners[0]);
    bounds.block = surface.faces[f].block;
    all.push_back(bounds);
  }
  return all;
}

// Lowest and highest corner of a face above the plane of another.
struct Span {
  double low, high;  // [m]

  [[nodiscard]] bool beyond(double reach) const { return low > reach || high < -reach; }
};

template <int dim>
Span span_above(const FaceBounds<dim>& plane, const Corners<dim>& corners) {
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& corner : corners) {
    const double height = plane.normal.dot(corner) - plane.offset;
    span.low = std::min(span.low, height);
    span.high = std::max(span.high, height);
  }
  return span;
}

template <int dim>
class PairSearch {
 public:
  PairSearch(const Surface<dim>& surface, const ContactOptions& options)
      : surface_(surface), options_(options), bounds_(bounds_of(surface, options)), grid_(bounds_) {}

  [[nodiscard]] Candidates run() {
    auto scratch = grid_.make_scratch();
    for (const FaceId face : surface_.faces.ids()) {
      grid_.find(face, scratch);
      for (const FaceId other : scratch.found) {
        if (apart(face, other)) continue;
        add(face, other);
        add(other, face);
      }
    }
    return std::move(candidates_);
  }

 private:
  [[nodiscard]] bool apart(FaceId a, FaceId b) const {
    const double reach = std::max(bounds_[a].reach, bounds_[b].reach);
    return span_above<dim>(bounds_[a], corners_of(surface_, b)).beyond(reach) ||
           span_above<dim>(bounds_[b], corners_of(surface_, a)).beyond(reach);
  }

  void add(FaceId owner, FaceId target) {
    for (int corner = 0; corner < dim; ++corner) {
      const auto touch = touch_face(surface_, options_, owner, corner, target);
      if (!touch) continue;
      const auto spring = static_cast<std::uint32_t>(owner.index() * dim + corner);
      candidates_.springs.push_back({spring, target, std::abs(touch->gap), touch->facing});
    }
    if constexpr (dim == 3) add_edges(owner, target);
  }

  // An edge is searched with the first of its two faces.
  void add_edges(FaceId owner, FaceId target) {
    for (const EdgeId edge : surface_.face_edges[target]) {
      if (surface_.edges[edge].faces[0] != target || beyond(owner, edge)) continue;
      for (int side = 0; side < 3; ++side) {
        const auto touch = touch_edge(surface_, options_, owner, side, edge);
        if (!touch) continue;
        const auto semi_edge = static_cast<std::uint32_t>(owner.index() * 3 + side);
        candidates_.edges.push_back({semi_edge, edge, std::abs(touch->gap), std::abs(touch->along - 0.5)});
      }
    }
  }

  // Is the edge clear of the face's plane or of its box?
  [[nodiscard]] bool beyond(FaceId owner, EdgeId edge) const {
    const FaceBounds<dim>& face = bounds_[owner];
    const Point<dim>& start = surface_.mesh.nodes[surface_.edges[edge].nodes[0]];
    const Point<dim>& end = surface_.mesh.nodes[surface_.edges[edge].nodes[1]];
    const double low = face.normal.dot(start) - face.offset, high = face.normal.dot(end) - face.offset;
    if ((low > face.reach && high > face.reach) || (low < -face.reach && high < -face.reach)) return true;
    return (start.cwiseMin(end).array() > face.box.max().array()).any() ||
           (start.cwiseMax(end).array() < face.box.min().array()).any();
  }

  const Surface<dim>& surface_;
  const ContactOptions& options_;
  Table<FaceId, FaceBounds<dim>> bounds_;
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
