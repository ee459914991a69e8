#include "contact/face_bounds.h"

namespace scree::contact {

template <int dim>
Table<FaceId, FaceBounds<dim>> face_bounds(const Surface<dim>& surface, double tolerance) {
  Table<FaceId, FaceBounds<dim>> all;
  all.reserve(surface.faces.size());
  for (const FaceId f : surface.faces.ids()) {
    FaceBounds<dim> bounds;
    const Corners<dim> corners = corners_of(surface, f);
    for (const auto& corner : corners) bounds.box.extend(corner);
    bounds.reach = tolerance * surface.lengths[f];
    bounds.box.min().array() -= bounds.reach;
    bounds.box.max().array() += bounds.reach;
    bounds.normal = surface.normals[f];
    bounds.offset = bounds.normal.dot(corners[0]);
    bounds.block = surface.faces[f].block;
    all.push_back(bounds);
  }
  return all;
}

template Table<FaceId, FaceBounds<2>> face_bounds<2>(const Surface<2>&, double);
template Table<FaceId, FaceBounds<3>> face_bounds<3>(const Surface<3>&, double);

}  // namespace scree::contact
