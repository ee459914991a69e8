#include "engine/mesh/convex_pieces.h"

#include <map>
#include <optional>

#include "engine/mesh/merged_faces.h"
#include "engine/mesh/shell.h"
#include "engine/mesh/tetrahedron_faces.h"

namespace scree::mesh {

namespace {

ConvexPiece tetrahedron(const BlockMesh<3>& mesh, ElementId element) {
  ConvexPiece piece;
  for (const NodeId node : mesh.elements[element]) piece.vertices.push_back(mesh.nodes[node]);
  for (const auto& c : faces_of_tetrahedron) {
    const auto& p = piece.vertices;
    piece.faces.push_back({(p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]).normalized(), {c[0], c[1], c[2]}});
  }
  add_edges(piece);
  return piece;
}

// A face of the block's surface beside an edge.
struct Beside {
  Eigen::Vector3d normal;
  Eigen::Vector3d far;  // its corner away from the edge [m]
};

bool stands_out(const std::vector<Beside>& faces, const Eigen::Vector3d& on_edge) {
  if (faces.size() != 2) return false;
  const Eigen::Vector3d way = faces[1].far - on_edge;
  return faces[0].normal.dot(way) < -allowed_dent * way.norm();
}

// Which faces, edges and nodes of the elements are the block's.
void mark_inner(const BlockMesh<3>& mesh, const Block& block, std::vector<ConvexPiece>& pieces) {
  const auto& elements = block.elements;
  const NodeId first = *block.nodes.begin();
  std::map<std::array<NodeId, 3>, int> uses;
  std::map<std::array<NodeId, 2>, std::vector<Beside>> beside;
  const auto for_each_face = [&](const auto& use) {
    std::size_t p = 0;
    for (const ElementId e : elements) {
      for (ConvexPiece::Face& face : pieces[p++].faces) {
        const auto node = [&](int i) { return mesh.elements[e][face.corners[static_cast<std::size_t>(i)]]; };
        use(face, std::array{node(0), node(1), node(2)});
      }
    }
  };
  for_each_face([&](ConvexPiece::Face&, const std::array<NodeId, 3>& nodes) { ++uses[sorted(nodes)]; });
  for_each_face([&](ConvexPiece::Face& face, const std::array<NodeId, 3>& nodes) {
    face.inner = uses[sorted(nodes)] > 1;
    for (std::size_t i = 0; i < 3 && !face.inner; ++i) {
      beside[sorted(std::array{nodes[i], nodes[(i + 1) % 3]})].push_back({face.normal, mesh.nodes[nodes[(i + 2) % 3]]});
    }
  });
  std::size_t p = 0;
  for (const ElementId e : elements) {
    for (const NodeId node : mesh.elements[e]) pieces[p].nodes.push_back(node.value() - first.value());
    for (ConvexPiece::Edge& edge : pieces[p].edges) {
      const std::array nodes{mesh.elements[e][edge.corners[0]], mesh.elements[e][edge.corners[1]]};
      const std::vector<Beside>& faces = beside[sorted(nodes)];
      edge.inner = !stands_out(faces, mesh.nodes[nodes[0]]);
      if (!edge.inner) edge.beside = {faces[0].normal, faces[1].normal};
    }
    ++p;
  }
}

}  // namespace

std::vector<ConvexPiece> convex_pieces(const BlockMesh<3>& mesh, BlockId block) {
  const auto& elements = mesh.blocks[block].elements;
  if (elements.size() > 1) {
    const std::optional<Shell> shell = shell_of(mesh, block);
    if (shell && is_convex(*shell)) return {merged_faces(*shell)};
  }
  std::vector<ConvexPiece> pieces;
  for (const ElementId e : elements) pieces.push_back(tetrahedron(mesh, e));
  mark_inner(mesh, mesh.blocks[block], pieces);
  return pieces;
}

std::vector<std::vector<Eigen::Vector3d>> surface_edges(const BlockMesh<3>& mesh, BlockId block) {
  const auto& nodes = mesh.blocks[block].nodes;
  std::vector<std::vector<Eigen::Vector3d>> edges(nodes.size());
  Table<FaceId, Face<3>> faces;
  add_boundary_faces(mesh, block, faces);
  // A closed surface has every edge in both directions.
  for (const Face<3>& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeId from = face.nodes[i], to = face.nodes[(i + 1) % 3];
      edges[static_cast<std::size_t>(from.value() - (*nodes.begin()).value())].push_back(
          (mesh.nodes[to] - mesh.nodes[from]).normalized());
    }
  }
  return edges;
}

}  // namespace scree::mesh
