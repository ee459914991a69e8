#include "engine/mesh/shape_surfaces.h"

#include <algorithm>

namespace scree::mesh {

namespace {

template <int dim>
std::vector<std::string> names(const Box&) {
  std::vector<std::string> all{"x_low", "x_high", "y_low", "y_high"};
  if (dim == 3) all.insert(all.end(), {"z_low", "z_high"});
  return all;
}
template <int dim>
std::vector<std::string> names(const Sphere&) {
  return {"surface"};
}
template <int dim>
std::vector<std::string> names(const Cylinder&) {
  return {"side", "bottom", "top"};
}
template <int dim>
std::vector<std::string> names(const MeshFile&) {
  return {};
}

// Whether all corners of a face have this coordinate; nodes of flat faces lie in their plane to the bit.
template <int dim>
bool in_plane(const SimplexMesh<dim>& mesh, const OuterFace<dim>& face, int axis, double coordinate) {
  return std::all_of(face.begin(), face.end(), [&](std::size_t node) { return mesh.nodes[node][axis] == coordinate; });
}

// The place of a face's name among the names of the shape.
template <int dim>
std::size_t side(const Box& box, const SimplexMesh<dim>& mesh, const OuterFace<dim>& face) {
  for (int axis = 0; axis < dim; ++axis) {
    if (in_plane<dim>(mesh, face, axis, -box.size[axis] / 2)) return 2 * static_cast<std::size_t>(axis);
    if (in_plane<dim>(mesh, face, axis, box.size[axis] / 2)) return 2 * static_cast<std::size_t>(axis) + 1;
  }
  throw std::logic_error("name_surfaces: an outer face on no side of a box");
}
template <int dim>
std::size_t side(const Sphere&, const SimplexMesh<dim>&, const OuterFace<dim>&) {
  return 0;
}
template <int dim>
std::size_t side(const Cylinder& cylinder, const SimplexMesh<dim>& mesh, const OuterFace<dim>& face) {
  constexpr int axis = dim - 1;
  if (in_plane<dim>(mesh, face, axis, -cylinder.height / 2)) return 1;
  return in_plane<dim>(mesh, face, axis, cylinder.height / 2) ? 2 : 0;
}

}  // namespace

template <int dim>
void name_surfaces(const Shape& shape, Parts<dim>& parts) {
  parts.surfaces = std::visit([](const auto& s) { return names<dim>(s); }, shape);
  const auto name = [&](const auto& s) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(s)>, MeshFile>) {
      for (SimplexMesh<dim>& mesh : parts.meshes) {
        for (const OuterFace<dim>& face : outer_faces(mesh)) mesh.named.push_back({face, side<dim>(s, mesh, face)});
      }
    }
  };
  std::visit(name, shape);
}

template void name_surfaces<2>(const Shape&, Parts<2>&);
template void name_surfaces<3>(const Shape&, Parts<3>&);

}  // namespace scree::mesh
