#include "contact/overlap_search.h"

#include <algorithm>

#include "contact/face_bounds.h"

namespace scree::contact {

namespace {

using FacePairs = std::vector<std::pair<FaceId, FaceId>>;

// Pairs that cheap bounds do not dismiss, ascending.
template <int dim>
FacePairs near_pairs(const Surface<dim>& surface, const Table<FaceId, FaceBounds<dim>>& bounds, const Wanted& wanted) {
  const auto body_of = [&](FaceId face) { return surface.mesh.blocks[surface.faces[face].block].body; };
  const auto near = [&](FaceId a, FaceId b) {
    if (bounds[a].normal.dot(bounds[b].normal) > -least_opposed) return false;
    const double reach = std::min(bounds[a].reach, bounds[b].reach);
    // Heights above an inclined plane are at most 1/cos of the gap between the faces.
    return !all_beyond(heights_above<dim>(bounds[b], corners_of(surface, a)), reach / least_opposed) &&
           !all_beyond(heights_above<dim>(bounds[a], corners_of(surface, b)), reach / least_opposed);
  };
  const FaceGrid<dim> grid(bounds);
  auto scratch = grid.make_scratch();
  FacePairs pairs;
  for (const FaceId face : surface.faces.ids()) {
    grid.find(face, scratch);
    for (const FaceId other : scratch.found) {
      if (near(face, other) && wanted(body_of(face), body_of(other))) pairs.push_back(std::minmax(face, other));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <int dim>
Contact<dim> as_contact(const Surface<dim>& surface, FaceId first, FaceId second, const OverlapPoint<dim>& at) {
  Contact<dim> contact;
  contact.kind = Kind::overlap;
  contact.owner = surface.faces[first].block;
  contact.target = surface.faces[second].block;
  contact.on_owner = {surface.faces[first].nodes, at.on_first};
  contact.on_target = {surface.faces[second].nodes, at.on_second};
  contact.literal_owner = contact.on_owner;
  contact.owner_element = surface.faces[first].element;
  contact.target_element = surface.faces[second].element;
  contact.area = at.area;
  contact.length = 1 / (1 / surface.lengths[first] + 1 / surface.lengths[second]);
  contact.gap = at.gap;
  contact.point = 0.5 * (weighted_point<dim>(corners_of(surface, first), at.on_first) +
                         weighted_point<dim>(corners_of(surface, second), at.on_second));
  return contact;
}

}  // namespace

template <int dim>
void visit_overlaps(const Surface<dim>& surface, double tolerance, const Wanted& wanted, const VisitOverlap<dim>& visit) {
  const auto bounds = face_bounds(surface, tolerance);
  std::vector<OverlapPoint<dim>> points;
  for (const auto& [first, second] : near_pairs(surface, bounds, wanted)) {
    const auto pair = opposed_faces<dim>(corners_of(surface, first), surface.normals[first], corners_of(surface, second),
                                         surface.normals[second]);
    if (!pair) continue;
    overlap_points(*pair, std::min(bounds[first].reach, bounds[second].reach), points);
    if (!points.empty()) visit(first, second, points);
  }
}

template <int dim>
std::vector<Contact<dim>> overlap_contacts(const Surface<dim>& surface, const ContactOptions& options) {
  std::vector<Contact<dim>> contacts;
  const auto wanted = [&](BodyId a, BodyId b) { return options.model_of(a, b) == Model::overlap; };
  visit_overlaps<dim>(surface, options.tolerance, wanted,
                      [&](FaceId first, FaceId second, const std::vector<OverlapPoint<dim>>& points) {
                        for (const auto& point : points) contacts.push_back(as_contact<dim>(surface, first, second, point));
                      });
  return contacts;
}

template <int dim>
std::map<std::pair<BodyId, BodyId>, double> overlap_areas(const mesh::BlockMesh<dim>& mesh, double tolerance) {
  const Surface<dim> surface = make_surface(mesh);
  const auto body_of = [&](FaceId face) { return mesh.blocks[surface.faces[face].block].body; };
  std::map<std::pair<BodyId, BodyId>, double> areas;
  visit_overlaps<dim>(
      surface, tolerance, [](BodyId, BodyId) { return true; },
      [&](FaceId first, FaceId second, const std::vector<OverlapPoint<dim>>& points) {
        double& area = areas[std::minmax(body_of(first), body_of(second))];
        for (const auto& point : points) area += point.area;
      });
  return areas;
}

#define SCREE_INSTANTIATE(dim)                                                                             \
  template void visit_overlaps<dim>(const Surface<dim>&, double, const Wanted&, const VisitOverlap<dim>&); \
  template std::vector<Contact<dim>> overlap_contacts<dim>(const Surface<dim>&, const ContactOptions&);    \
  template std::map<std::pair<BodyId, BodyId>, double> overlap_areas<dim>(const mesh::BlockMesh<dim>&, double);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
