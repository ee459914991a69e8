#include "contact/overlap_search.h"

#include <algorithm>

#include "contact/near_shells.h"
#include "engine/base/chunks.h"

namespace scree::contact {

namespace {

using FacePairs = std::vector<std::pair<FaceId, FaceId>>;

// Are all corners of a face more than `reach` on one side of a plane of the other shell?
template <int dim>
bool all_beyond(const std::array<double, dim + 1>& heights, const std::array<std::int8_t, dim>& corners, double reach) {
  double low = heights[corners[0]], high = low;
  for (const int corner : corners) {
    low = std::min(low, heights[corner]);
    high = std::max(high, heights[corner]);
  }
  return low > reach || high < -reach;
}

// The pairs of faces of two shells that may lie on each other.
template <int dim>
void add_faces(const ShellPair<dim>& pair, FacePairs& pairs) {
  const Shell<dim>&a = pair.first, &b = pair.second;
  // Heights above an inclined plane are at most 1/cos of the gap between the faces.
  const double reach = std::min(a.reach, b.reach) / least_opposed;
  for (int i = 0; i < a.faces; ++i) {
    for (int j = 0; j < b.faces; ++j) {
      if (a.normals[i].dot(b.normals[j]) > -least_opposed) continue;
      if (all_beyond<dim>(pair.above_first[i], b.corners[j], reach) ||
          all_beyond<dim>(pair.above_second[j], a.corners[i], reach))
        continue;
      pairs.push_back(std::minmax(a.face(i), b.face(j)));
    }
  }
}

// Pairs that cheap bounds do not dismiss, ascending.
template <int dim>
FacePairs near_pairs(const Surface<dim>& surface, double tolerance, const Wanted& wanted) {
  const ShellTable<dim> table = make_shells(surface, {tolerance, 0});
  const auto body_of = [&](const Shell<dim>& shell) { return surface.mesh.blocks[shell.block].body; };
  std::vector<FacePairs> found(chunk_count(table.shells.size()));
  visit_near<dim>(table, [&](std::size_t chunk, const ShellPair<dim>& pair) {
    if (wanted(body_of(pair.first), body_of(pair.second))) add_faces(pair, found[chunk]);
  });
  FacePairs pairs;
  for (const FacePairs& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
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
  std::vector<OverlapPoint<dim>> points;
  for (const auto& [first, second] : near_pairs(surface, tolerance, wanted)) {
    const auto pair = opposed_faces<dim>(corners_of(surface, first), surface.normals[first], corners_of(surface, second),
                                         surface.normals[second]);
    if (!pair) continue;
    overlap_points(*pair, tolerance * std::min(surface.lengths[first], surface.lengths[second]), points);
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
  if (mesh.blocks.size() < 2) return {};
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
