#include "contact/shell.h"

#include <algorithm>
#include <limits>

namespace scree::contact {

namespace {

void add_sides(const Surface<3>& surface, FaceId f, Shell<3>& shell) {
  const int at = shell.faces - 1;
  double shortest = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 3; ++side) {
    const auto [low, high] = std::minmax({shell.corners[at][side], shell.corners[at][(side + 1) % 3]});
    const double length = (shell.vertex(high) - shell.vertex(low)).norm();
    shortest = std::min(shortest, length);
    shell.longest = std::max(shell.longest, length);
    // element_edges has them in the order of their vertices.
    EdgeSides& edge = shell.edges[low == 0 ? high - 1 : low + high];
    const auto number = static_cast<std::int8_t>(3 * at + side);
    edge.sides[edge.sides[0] < 0 ? 0 : 1] = number;
    if (surface.edges[surface.face_edges[f][side]].faces[0] == f) edge.first = number;
  }
  // The centre is a third of the height above each edge.
  shell.shift = std::max(shell.shift, 2 * surface.areas[f] / shortest / 3);
}

template <int dim>
void add_face(const Surface<dim>& surface, FaceId f, const std::array<NodeId, dim + 1>& nodes, Shell<dim>& shell) {
  const int at = shell.faces++;
  for (int i = 0; i < dim; ++i) {
    const auto vertex = std::find(nodes.begin(), nodes.end(), surface.faces[f].nodes[i]) - nodes.begin();
    shell.corners[at][i] = static_cast<std::int8_t>(vertex);
  }
  shell.normals[at] = surface.normals[f];
  shell.offsets[at] = shell.normals[at].dot(shell.vertex(shell.corners[at][0]));
  if constexpr (dim == 3) add_sides(surface, f, shell);
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
  for (int i = 0; i <= dim; ++i) {
    for (int axis = 0; axis < dim; ++axis) shell.at[axis][i] = surface.mesh.nodes[nodes[i]][axis];
  }
  shell.first = first;
  shell.block = surface.faces[first].block;
  shell.whole = surface.mesh.blocks[shell.block].elements.size() == 1;
  shell.reach = options.tolerance * surface.lengths[first];
  for (std::size_t f = first.index(); f < end.index(); ++f) add_face<dim>(surface, FaceId{f}, nodes, shell);
  shell.shift *= options.indentation;
  return shell;
}

#define SCREE_INSTANTIATE(dim)                                         \
  template std::vector<FaceId> shell_starts<dim>(const Surface<dim>&); \
  template Shell<dim> make_shell<dim>(const Surface<dim>&, FaceId, FaceId, const ShellOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
