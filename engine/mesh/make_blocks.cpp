#include "engine/mesh/make_blocks.h"

#include <algorithm>

#include "engine/mesh/arrangement.h"
#include "engine/mesh/mesh_file.h"
#include "engine/mesh/shape_mesh.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

namespace {

template <int dim>
Parts<dim> mesh_parts(const BodySpec& body, const MeshReaders& readers) {
  if (std::holds_alternative<MeshFile>(body.shape)) return mesh_file<dim>(body, readers);
  return {mesh_shape<dim>(body)};
}

template <int dim>
Bounds bounds_of(const Parts<dim>& parts) {
  Aabb<dim> box;
  for (const SimplexMesh<dim>& part : parts) {
    for (const Point<dim>& node : part.nodes) box.extend(node);
  }
  const Point<dim> centre = box.center();
  double radius_sq = 0;
  for (const SimplexMesh<dim>& part : parts) {
    for (const Point<dim>& node : part.nodes) radius_sq = std::max(radius_sq, (node - centre).squaredNorm());
  }
  Bounds bounds{.radius = std::sqrt(radius_sq)};
  bounds.centre.head<dim>() = centre;
  return bounds;
}

// Every element on its own.
template <int dim>
Parts<dim> broken(const Parts<dim>& parts) {
  Parts<dim> pieces;
  for (const SimplexMesh<dim>& part : parts) {
    for (const auto& element : part.elements) {
      SimplexMesh<dim> piece;
      for (std::size_t corner = 0; corner < element.size(); ++corner) {
        piece.nodes.push_back(part.nodes[element[corner]]);
        if (corner == 0) piece.elements.emplace_back();
        piece.elements[0][corner] = corner;
      }
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

template <int dim>
void add_block(BlockMesh<dim>& mesh, BodyId body, const SimplexMesh<dim>& part, const Pose& pose) {
  const std::size_t first_node = mesh.nodes.size(), first_element = mesh.elements.size();
  for (const Point<dim>& node : part.nodes) {
    Eigen::Vector3d reference = Eigen::Vector3d::Zero();
    reference.head<dim>() = node;
    mesh.nodes.push_back((pose * reference).template head<dim>());
  }
  for (const auto& element : part.elements) {
    typename BlockMesh<dim>::Element nodes;
    for (std::size_t corner = 0; corner < element.size(); ++corner) nodes[corner] = NodeId{first_node + element[corner]};
    mesh.elements.push_back(nodes);
  }
  mesh.blocks.push_back({body, {first_node, mesh.nodes.size()}, {first_element, mesh.elements.size()}});
}

}  // namespace

template <int dim>
BlockMesh<dim> make_blocks(const std::vector<BodySpec>& bodies, const MeshReaders& readers) {
  BlockMesh<dim> mesh;
  std::vector<Parts<dim>> meshed;  // as `bodies`; a shape that comes again is not meshed again
  for (const BodySpec& body : bodies) {
    const auto same = std::find_if(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(meshed.size()),
                                   [&](const BodySpec& b) { return b.shape == body.shape && b.mesh_size == body.mesh_size; });
    const auto before = static_cast<std::size_t>(same - bodies.begin());
    meshed.push_back(before < meshed.size() ? meshed[before] : mesh_parts<dim>(body, readers));
    const Parts<dim>& whole = meshed.back();
    const Parts<dim> pieces = body.blocks == BlockRule::per_element ? broken(whole) : whole;
    const BodyId id = mesh.bodies.push_back({body.name, body.material, body.fixed, body.velocity});
    for (const Pose& pose : poses_of(body, bounds_of(whole), dim)) {
      for (const SimplexMesh<dim>& piece : pieces) add_block(mesh, id, piece, pose);
    }
  }
  return mesh;
}

template BlockMesh<2> make_blocks<2>(const std::vector<BodySpec>&, const MeshReaders&);
template BlockMesh<3> make_blocks<3>(const std::vector<BodySpec>&, const MeshReaders&);

}  // namespace scree::mesh
