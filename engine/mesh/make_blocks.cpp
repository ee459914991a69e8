#include "engine/mesh/make_blocks.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "engine/mesh/arrangement.h"
#include "engine/mesh/made_from.h"
#include "engine/mesh/mesh_file.h"
#include "engine/mesh/problems.h"
#include "engine/mesh/shape_mesh.h"
#include "engine/mesh/shape_surfaces.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

namespace {

template <int dim>
Parts<dim> mesh_parts(const BodySpec& body, const MeshReaders& readers) {
  if (std::holds_alternative<MeshFile>(body.shape)) {
    if (!body.cells) return mesh_file<dim>(body, readers);
    throw body_error(body, "elements", kind_name(*body.cells), "is for shapes; a mesh file says what its elements are",
                     "Leave it away");
  }
  Parts<dim> parts{{mesh_shape<dim>(body)}, {}};
  name_surfaces<dim>(body.shape, parts);
  return parts;
}

template <int dim>
Bounds bounds_of(const Parts<dim>& parts) {
  Aabb<dim> box;
  for (const SimplexMesh<dim>& part : parts.meshes) {
    for (const Point<dim>& node : part.nodes) box.extend(node);
  }
  const Point<dim> centre = box.center();
  double radius_sq = 0;
  for (const SimplexMesh<dim>& part : parts.meshes) {
    for (const Point<dim>& node : part.nodes) radius_sq = std::max(radius_sq, (node - centre).squaredNorm());
  }
  Bounds bounds{.radius = std::sqrt(radius_sq)};
  bounds.centre.head<dim>() = centre;
  return bounds;
}

// Calls `visit` with every surface that the face lies on.
template <int dim, class Visit>
void names_of(OuterFace<dim> nodes, const std::vector<NamedFace<dim>>& named, const Visit& visit) {
  std::sort(nodes.begin(), nodes.end());
  const auto before = [](const NamedFace<dim>& face, const OuterFace<dim>& value) { return face.nodes < value; };
  auto face = std::lower_bound(named.begin(), named.end(), nodes, before);
  for (; face != named.end() && face->nodes == nodes; ++face) visit(face->surface);
}

// Calls `visit` with every named face that has all its nodes among `element`, and with the places of its nodes there.
template <int dim, class Visit>
void faces_of(const std::array<std::size_t, dim + 1>& element, const std::vector<NamedFace<dim>>& named, const Visit& visit) {
  for (std::size_t out = 0; out <= dim; ++out) {
    OuterFace<dim> nodes, corners;
    for (std::size_t i = 0, k = 0; i <= dim; ++i) {
      if (i != out) corners[k++] = i;
    }
    std::transform(corners.begin(), corners.end(), nodes.begin(), [&](std::size_t corner) { return element[corner]; });
    names_of<dim>(nodes, named, [&](std::size_t surface) { visit(NamedFace<dim>{corners, surface}); });
  }
}

// A cell on its own, with its elements and its named faces: those that have no node outside of it.
template <int dim>
SimplexMesh<dim> lone_cell(const SimplexMesh<dim>& part, const RawLargeCell& cell, std::size_t first_element,
                           const std::vector<NamedFace<dim>>& named) {
  const auto end = cell.nodes.begin() + static_cast<std::ptrdiff_t>(corner_count(cell.kind));
  const auto place = [&](std::size_t node) {
    return static_cast<std::size_t>(std::find(cell.nodes.begin(), end, node) - cell.nodes.begin());
  };
  SimplexMesh<dim> piece;
  piece.cells.push_back(cell);
  std::iota(piece.cells[0].nodes.begin(), piece.cells[0].nodes.end(), std::size_t{0});
  std::for_each(cell.nodes.begin(), end, [&](std::size_t node) { piece.nodes.push_back(part.nodes[node]); });
  for (std::size_t e = 0; e < split_count(cell.kind); ++e) {
    auto element = part.elements[first_element + e];
    for (std::size_t& node : element) node = place(node);
    piece.elements.push_back(element);
  }
  for (OuterFace<dim> corners : outer_faces(piece)) {
    OuterFace<dim> nodes;
    std::transform(corners.begin(), corners.end(), nodes.begin(), [&](std::size_t corner) { return cell.nodes[corner]; });
    names_of<dim>(nodes, named, [&](std::size_t surface) { piece.named.push_back({corners, surface}); });
  }
  return piece;
}

// Every element or cell on its own.
template <int dim>
Parts<dim> broken(const Parts<dim>& parts) {
  Parts<dim> pieces{{}, parts.surfaces};
  for (const SimplexMesh<dim>& part : parts.meshes) {
    auto named = part.named;
    std::sort(named.begin(), named.end(), [](const auto& a, const auto& b) { return a.nodes < b.nodes; });
    std::size_t first_element = 0;
    for (const RawLargeCell& cell : part.cells) {
      pieces.meshes.push_back(lone_cell(part, cell, first_element, named));
      first_element += split_count(cell.kind);
    }
    if (!part.cells.empty()) continue;
    for (const auto& element : part.elements) {
      SimplexMesh<dim> piece;
      for (std::size_t corner = 0; corner < element.size(); ++corner) {
        piece.nodes.push_back(part.nodes[element[corner]]);
        if (corner == 0) piece.elements.emplace_back();
        piece.elements[0][corner] = corner;
      }
      faces_of<dim>(element, named, [&](const NamedFace<dim>& face) { piece.named.push_back(face); });
      pieces.meshes.push_back(std::move(piece));
    }
  }
  return pieces;
}

// Adds a block of the body added last; its surfaces begin with `first_surface`.
template <int dim>
void add_block(BlockMesh<dim>& mesh, std::size_t first_surface, const SimplexMesh<dim>& part, const Pose& pose) {
  const BodyId body{mesh.bodies.size() - 1};
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
  const std::size_t first_cell = mesh.cells.size();
  for (const RawLargeCell& cell : part.cells) {
    Cell placed{cell.kind, {}};
    for (std::size_t i = 0; i < corner_count(cell.kind); ++i) placed.nodes[i] = NodeId{first_node + cell.nodes[i]};
    mesh.cells.push_back(placed);
  }
  for (const NamedFace<dim>& face : part.named) {
    SurfaceFace<dim> placed;
    std::transform(face.nodes.begin(), face.nodes.end(), placed.nodes.begin(),
                   [&](std::size_t node) { return NodeId{first_node + node}; });
    placed.surface = SurfaceId{first_surface + face.surface};
    mesh.surfaces.push_back(placed);
  }
  mesh.blocks.push_back({body,
                         {first_node, mesh.nodes.size()},
                         {first_element, mesh.elements.size()},
                         {first_cell, mesh.cells.size()},
                         pose.rotation});
}

// For as many more entries, and for twice as many as before if there are too few: what bodies add one after the other is not
// moved for each of them.
template <class Entries>
void make_room(Entries& entries, std::size_t more) {
  const std::size_t needed = entries.size() + more, there = entries.raw().capacity();
  if (needed > there) entries.reserve(std::max(needed, 2 * there));
}

template <int dim>
void make_room(BlockMesh<dim>& mesh, const Parts<dim>& pieces, std::size_t copies) {
  std::size_t nodes = 0, elements = 0;
  for (const SimplexMesh<dim>& piece : pieces.meshes) {
    nodes += piece.nodes.size();
    elements += piece.elements.size();
  }
  make_room(mesh.nodes, copies * nodes);
  make_room(mesh.elements, copies * elements);
  make_room(mesh.blocks, copies * pieces.meshes.size());
}

// Coordinates have 16 digits.
void check_distance(const BodySpec& body, const Bounds& bounds, const std::vector<Pose>& poses) {
  constexpr double most = 1e10;
  for (const Pose& pose : poses) {
    const double distance = (pose * bounds.centre).norm();
    if (distance <= most * bounds.radius) continue;
    throw body_error(body, "", fmt::format("{:g} m from the origin", distance),
                     fmt::format("must be within {:g} times its size of it: coordinates are rounded", most),
                     "Count coordinates from a point in the scene");
  }
}

// How a body breaks into blocks decides what is asked of a mesh file (volume_mesh.h).
bool gives_same_mesh(const BodySpec& a, const BodySpec& b) {
  const bool asked_the_same = a.blocks == b.blocks || !std::holds_alternative<MeshFile>(a.shape);
  return a.shape == b.shape && a.mesh_size == b.mesh_size && a.cells == b.cells && asked_the_same;
}

}  // namespace

template <int dim>
BlockMesh<dim> make_blocks(const std::vector<BodySpec>& bodies, const MeshReaders& readers) {
  BlockMesh<dim> mesh;
  std::vector<Parts<dim>> meshed;  // as `bodies`; a shape that comes again is not meshed again
  for (const BodySpec& body : bodies) {
    const auto same = std::find_if(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(meshed.size()),
                                   [&](const BodySpec& b) { return gives_same_mesh(b, body); });
    const auto before = static_cast<std::size_t>(same - bodies.begin());
    meshed.push_back(before < meshed.size() ? meshed[before] : mesh_parts<dim>(body, readers));
    const Parts<dim>& whole = meshed.back();
    const bool breaks = body.blocks == BlockRule::per_element;
    const Parts<dim> singles = breaks ? broken(whole) : Parts<dim>{};
    const Parts<dim>& pieces = breaks ? singles : whole;
    const BodyId id = mesh.bodies.push_back({body.name, body.material, body.fixed, body.velocity, made_from(body)});
    const std::size_t first_surface = mesh.surface_names.size();
    for (const std::string& name : whole.surfaces) mesh.surface_names.push_back({id, name});
    const Bounds bounds = bounds_of(whole);
    const std::vector<Pose> poses = poses_of(body, bounds, dim);
    check_distance(body, bounds, poses);
    make_room(mesh, pieces, poses.size());
    for (const Pose& pose : poses) {
      for (const SimplexMesh<dim>& piece : pieces.meshes) add_block(mesh, first_surface, piece, pose);
    }
  }
  std::sort(mesh.surfaces.begin(), mesh.surfaces.end());
  return mesh;
}

template BlockMesh<2> make_blocks<2>(const std::vector<BodySpec>&, const MeshReaders&);
template BlockMesh<3> make_blocks<3>(const std::vector<BodySpec>&, const MeshReaders&);

}  // namespace scree::mesh
