#include "contact/shell.h"

#include <algorithm>
#include <cmath>

#include "contact/coordinates.h"
#include "contact/tetrahedron.h"

namespace scree::contact {

namespace {

// The vertices of an element or the planes opposite to them, a lane each; a triangle's last lane repeats the first.
template <int dim>
using Corner = Coordinates<dim, Quad>;

constexpr int fourth(int dim) {
  return dim == 3 ? 3 : 0;
}

// Of each plane a vertex in it.
template <int dim, int corner>
SCREE_INLINE Quad in_planes(const Quad& of_vertices) {
  constexpr auto& corners = mesh::opposite_corners<dim>;
  return __builtin_shufflevector(of_vertices, of_vertices, corners[0][corner], corners[1][corner], corners[2][corner],
                                 corners[fourth(dim)][corner]);
}

template <int dim, int corner>
SCREE_INLINE Corner<dim> in_planes(const Corner<dim>& vertices) {
  Corner<dim> result;
  for (int i = 0; i < dim; ++i) result[i] = in_planes<dim, corner>(vertices[i]);
  return result;
}

// Outward unit normals of the planes.
template <int dim>
SCREE_INLINE Corner<dim> normals_of(const Corner<dim>& vertices) {
  const Corner<dim> from = in_planes<dim, 0>(vertices), way = minus<dim>(in_planes<dim, 1>(vertices), from);
  Corner<dim> normals;
  if constexpr (dim == 2) {
    normals = {way[1], -way[0]};
  } else {
    normals = cross(way, minus<dim>(in_planes<dim, 2>(vertices), from));
  }
  const Quad length = root(dot<dim>(normals, normals));
  for (Quad& axis : normals) axis /= length;
  return normals;
}

SCREE_INLINE double largest(const Quad& numbers) {
  return std::max(std::max(numbers[0], numbers[1]), std::max(numbers[2], numbers[3]));
}

SCREE_INLINE Quad larger(const Quad& a, const Quad& b) {
  return a > b ? a : b;
}

SCREE_INLINE double longest_edge(const Corner<3>& vertices) {
  Corner<3> next, opposite;
  for (int i = 0; i < 3; ++i) {
    next[i] = vertices[i] - __builtin_shufflevector(vertices[i], vertices[i], 1, 2, 3, 0);
    opposite[i] = vertices[i] - __builtin_shufflevector(vertices[i], vertices[i], 2, 3, 0, 1);
  }
  return std::sqrt(largest(larger(dot<3>(next, next), dot<3>(opposite, opposite))));
}

SCREE_INLINE void put(const Quad& numbers, Lanes& lanes) {
  lanes = __builtin_convertvector(numbers, Lanes);
}

// `vertices`: as seen from the centre.
template <int dim>
SCREE_INLINE void place(const Corner<dim>& vertices, const ShellOptions& options, Shell<dim>& shell) {
  const Corner<dim> normals = normals_of<dim>(vertices);
  for (int i = 0; i < dim; ++i) {
    put(vertices[i], shell.at[i]);
    put(normals[i], shell.normals[i]);
  }
  put(dot<dim>(normals, in_planes<dim, 0>(vertices)), shell.offsets);
  shell.radius = static_cast<float>(std::sqrt(largest(dot<dim>(vertices, vertices))));
  // The centre of a face is a third of its height above an edge.
  if constexpr (dim == 3) shell.shift = static_cast<float>(options.indentation * longest_edge(vertices) / 3);
}

constexpr std::array<std::array<int, 3>, 4> edges_of_sides = [] {
  std::array<std::array<int, 3>, 4> edges{};
  for (std::size_t e = 0; e < element_edges.size(); ++e) {
    for (const int face : element_edges[e].beside) edges[face][side_of(element_edges[e], face)] = static_cast<int>(e);
  }
  return edges;
}();

// A target edge is searched in the shell of its first face.
void add_edges(const Surface<3>& surface, int plane, FaceId face, Shell<3>& shell) {
  for (int side = 0; side < 3; ++side) {
    const EdgeId edge = surface.face_edges[face][side];
    const bool here = surface.edges[edge].faces[0] == face;
    const int e = edges_of_sides[plane][side];
    shell.edges = static_cast<std::uint8_t>(shell.edges | (here ? 1u : 0u) << e);
    shell.targets[e] = here ? edge : shell.targets[e];
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
  shell.centre.setZero();
  for (const NodeId node : nodes) shell.centre += surface.mesh.nodes[node] / (dim + 1);
  widely([&](auto) SCREE_INLINED {
    Corner<dim> vertices;
    for (int i = 0; i < dim; ++i) {
      const auto at = [&](int v) SCREE_INLINED { return surface.mesh.nodes[nodes[v]][i]; };
      vertices[i] = Quad{at(0), at(1), at(2), at(fourth(dim))} - shell.centre[i];
    }
    place<dim>(vertices, options, shell);
  });
  shell.length = static_cast<float>(surface.lengths[first]);
  shell.reach = static_cast<float>(options.tolerance * surface.lengths[first]);
  shell.block = surface.faces[first].block;
  shell.whole = is_whole(surface.mesh, shell.block);
  shell.first = first;
  const bool with_edges = dim == 3 && !surface.face_edges.empty();
  for (std::size_t f = first.index(); f < end.index(); ++f) {
    const int plane = opposite_vertex(surface, FaceId{f});
    shell.faces = static_cast<std::uint8_t>(shell.faces | 1u << plane);
    if constexpr (dim == 3) {
      if (with_edges) add_edges(surface, plane, FaceId{f}, shell);
    }
  }
  shell.open = shell.faces;
  return shell;
}

#define SCREE_INSTANTIATE(dim)                                         \
  template std::vector<FaceId> shell_starts<dim>(const Surface<dim>&); \
  template Shell<dim> make_shell<dim>(const Surface<dim>&, FaceId, FaceId, const ShellOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
