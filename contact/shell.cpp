#include "contact/shell.h"

#include <algorithm>
#include <cmath>

#include "contact/tetrahedron.h"

namespace scree::contact {

namespace {

template <int dim>
using Vertices = std::array<Point<dim>, dim + 1>;

// Outward normal of the face opposite to a vertex, of any length.
template <int dim>
Point<dim> outward(const Vertices<dim>& vertices, int opposite) {
  const auto& corners = mesh::opposite_corners<dim>[opposite];
  const Point<dim> way = vertices[corners[1]] - vertices[corners[0]];
  if constexpr (dim == 2) {
    return {way.y(), -way.x()};
  } else {
    return way.cross(vertices[corners[2]] - vertices[corners[0]]);
  }
}

// Lanes beyond the last vertex repeat the first.
template <int dim>
void place_vertices(const Surface<dim>& surface, const Vertices<dim>& vertices, Shell<dim>& shell) {
  for (int lane = 0; lane < lane_count; ++lane) {
    const int v = lane <= dim ? lane : 0;
    const bool boundary = (shell.faces >> v & 1u) != 0;
    const Point<dim> normal = boundary ? surface.normals[shell.face(v)] : outward<dim>(vertices, v).normalized();
    shell.offsets[lane] = static_cast<float>(normal.dot(vertices[mesh::opposite_corners<dim>[v][0]]));
    for (int i = 0; i < dim; ++i) {
      shell.at[i][lane] = static_cast<float>(vertices[v][i]);
      shell.normals[i][lane] = static_cast<float>(normal[i]);
    }
  }
}

template <int dim>
double longest_edge(const Vertices<dim>& vertices) {
  double square = 0;
  for (int i = 0; i <= dim; ++i) {
    for (int j = 0; j < i; ++j) square = std::max(square, (vertices[i] - vertices[j]).squaredNorm());
  }
  return std::sqrt(square);
}

// Is the face that is opposite to a vertex this one of the surface?
template <int dim>
bool is_opposite(const Surface<dim>& surface, FaceId face, NodeId vertex) {
  const auto& nodes = surface.faces[face].nodes;
  return std::find(nodes.begin(), nodes.end(), vertex) == nodes.end();
}

// A target edge is searched in the shell of its first face.
void add_edges(const Surface<3>& surface, Shell<3>& shell) {
  for (unsigned e = 0; e < element_edges.size(); ++e) {
    for (const int face : element_edges[e].beside) {
      if ((shell.faces >> face & 1u) == 0) continue;
      const FaceId f = shell.face(face);
      const EdgeId edge = surface.face_edges[f][side_of(element_edges[e], face)];
      if (surface.edges[edge].faces[0] != f) continue;
      shell.edges = static_cast<std::uint8_t>(shell.edges | 1u << e);
      shell.targets[e] = edge;
    }
  }
}

}  // namespace

template <int dim>
std::vector<FaceId> shell_starts(const Surface<dim>& surface) {
  std::vector<FaceId> starts;
  starts.reserve(surface.faces.size() / dim);
  for (const FaceId f : surface.faces.ids()) {
    if (starts.empty() || surface.faces[starts.back()].element != surface.faces[f].element) starts.push_back(f);
  }
  return starts;
}

template <int dim>
Shell<dim> make_shell(const Surface<dim>& surface, FaceId first, FaceId end, const ShellOptions& options) {
  Shell<dim> shell;
  const auto& nodes = surface.mesh.elements[surface.faces[first].element];
  Vertices<dim> vertices;
  shell.centre.setZero();
  for (int v = 0; v <= dim; ++v) {
    vertices[v] = surface.mesh.nodes[nodes[v]];
    shell.centre += vertices[v] / (dim + 1);
  }
  double square = 0;
  for (Point<dim>& vertex : vertices) {
    vertex -= shell.centre;
    square = std::max(square, vertex.squaredNorm());
  }
  shell.radius = static_cast<float>(std::sqrt(square));
  shell.reach = static_cast<float>(options.tolerance * surface.lengths[first]);
  // The centre of a face is a third of its height above an edge.
  if constexpr (dim == 3) shell.shift = static_cast<float>(options.indentation * longest_edge<dim>(vertices) / 3);
  shell.block = surface.faces[first].block;
  shell.whole = surface.mesh.blocks[shell.block].elements.size() == 1;
  shell.first = first;
  FaceId next = first;
  for (int v = 0; v <= dim && next < end; ++v) {
    if (!is_opposite(surface, next, nodes[v])) continue;
    shell.faces = static_cast<std::uint8_t>(shell.faces | 1u << v);
    next = FaceId{next.index() + 1};
  }
  place_vertices(surface, vertices, shell);
  if constexpr (dim == 3) {
    if (!surface.face_edges.empty()) add_edges(surface, shell);
  }
  return shell;
}

#define SCREE_INSTANTIATE(dim)                                         \
  template std::vector<FaceId> shell_starts<dim>(const Surface<dim>&); \
  template Shell<dim> make_shell<dim>(const Surface<dim>&, FaceId, FaceId, const ShellOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
