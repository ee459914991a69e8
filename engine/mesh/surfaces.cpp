#include "engine/mesh/surfaces.h"

#include <algorithm>

namespace scree::mesh {

template <int dim>
std::optional<SurfaceId> find_surface(const BlockMesh<dim>& mesh, BodyId body, const std::string& name) {
  for (const SurfaceId id : mesh.surface_names.ids()) {
    const NamedSurface& surface = mesh.surface_names[id];
    if (surface.body == body && surface.name == name) return id;
  }
  return std::nullopt;
}

template <int dim>
std::vector<std::string> surface_names(const BlockMesh<dim>& mesh, BodyId body) {
  std::vector<std::string> names;
  for (const NamedSurface& surface : mesh.surface_names) {
    if (surface.body == body) names.push_back(surface.name);
  }
  return names;
}

template <int dim>
bool on_surface(const BlockMesh<dim>& mesh, std::array<NodeId, dim> face, SurfaceId surface) {
  std::sort(face.begin(), face.end());
  return std::binary_search(mesh.surfaces.begin(), mesh.surfaces.end(), SurfaceFace<dim>{face, surface});
}

template <int dim>
std::vector<NodeId> surface_nodes(const BlockMesh<dim>& mesh, SurfaceId surface) {
  std::vector<NodeId> nodes;
  for (const SurfaceFace<dim>& face : mesh.surfaces) {
    if (face.surface == surface) nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

#define SCREE_INSTANTIATE(dim)                                                                            \
  template std::optional<SurfaceId> find_surface<dim>(const BlockMesh<dim>&, BodyId, const std::string&); \
  template std::vector<std::string> surface_names<dim>(const BlockMesh<dim>&, BodyId);                    \
  template bool on_surface<dim>(const BlockMesh<dim>&, std::array<NodeId, dim>, SurfaceId);               \
  template std::vector<NodeId> surface_nodes<dim>(const BlockMesh<dim>&, SurfaceId);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::mesh
