// Named surfaces of bodies: which there are, and what lies on them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// The body's surface of this name, if it has one.
template <int dim>
std::optional<SurfaceId> find_surface(const BlockMesh<dim>& mesh, BodyId body, const std::string& name);

// The names of the body's surfaces, in the order of the shape or file.
template <int dim>
std::vector<std::string> surface_names(const BlockMesh<dim>& mesh, BodyId body);

// Whether the face with these nodes, in any order, lies on the surface.
template <int dim>
bool on_surface(const BlockMesh<dim>& mesh, std::array<NodeId, dim> face, SurfaceId surface);

// The nodes of the surface's faces, ascending.
template <int dim>
std::vector<NodeId> surface_nodes(const BlockMesh<dim>& mesh, SurfaceId surface);

}  // namespace scree::mesh
