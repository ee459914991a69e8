#include "thermal/inner_field.h"

#include <algorithm>

#include <Eigen/IterativeLinearSolvers>

#include "engine/mesh/shell.h"

namespace scree::thermal {

namespace {

// A face of the surface as seen from one of its edges (2-D: from one of its ends).
template <int dim>
struct Side {
  std::array<NodeId, dim - 1> edge;  // ascending
  FaceId face;
  NodeId beside;  // the face's other corner
};

template <int dim>
std::vector<Side<dim>> sides_of(const Table<FaceId, mesh::Face<dim>>& faces) {
  std::vector<Side<dim>> sides;
  for (const FaceId face : faces.ids()) {
    for (int corner = 0; corner < dim; ++corner) {
      Side<dim> side;
      side.face = face;
      side.beside = faces[face].nodes[corner];
      for (int i = 0; i < dim - 1; ++i) side.edge[i] = faces[face].nodes[(corner + 1 + i) % dim];
      std::ranges::sort(side.edge);
      sides.push_back(side);
    }
  }
  std::ranges::sort(sides, {}, &Side<dim>::edge);
  return sides;
}

}  // namespace

// Unlike is_convex() of a shell in 2-D, too, and without the maps that a shell is made with: every lumped block is asked.
template <int dim>
bool is_dented(const mesh::BlockMesh<dim>& mesh, BlockId block) {
  if (mesh.blocks[block].elements.size() == 1) return false;
  Table<FaceId, mesh::Face<dim>> faces;
  mesh::add_boundary_faces(mesh, block, faces);
  const std::vector<Side<dim>> sides = sides_of<dim>(faces);
  // Of two faces at an edge: is the other one's corner above the plane of the one?
  const auto rises = [&](const Side<dim>& one, const Side<dim>& other) {
    const Point<dim> way = mesh.nodes[other.beside] - mesh.nodes[one.edge[0]];
    const Point<dim> normal = mesh::area_vector<dim>(mesh, faces[one.face].nodes).normalized();
    return normal.dot(way) > mesh::allowed_dent * way.norm();
  };
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i - 1].edge == sides[i].edge && rises(sides[i - 1], sides[i])) return true;
  }
  return false;
}

template <int dim>
InnerField<dim>::InnerField(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block, const Tensor<dim>& conductivity) {
  const auto size = static_cast<Eigen::Index>(block.nodes.size());
  const auto row = [&](NodeId node) { return static_cast<Eigen::Index>(node.index() - block.nodes.first()); };
  stored_ = Eigen::VectorXd::Zero(size);
  std::vector<Eigen::Triplet<double>> entries;
  for (const ElementId e : block.elements) {
    const auto& nodes = mesh.elements[e];
    const CornerMatrix<dim> of_element = element_conductance<dim>(corner_points(mesh, nodes), conductivity);
    const double share = corner_mass<dim>(mesh::element_volume(mesh, e), 1);
    for (int a = 0; a <= dim; ++a) {
      stored_[row(nodes[a])] += share;
      for (int b = 0; b <= dim; ++b) entries.emplace_back(row(nodes[a]), row(nodes[b]), of_element(a, b));
    }
  }
  stored_ /= stored_.sum();
  conductance_.resize(size, size);
  conductance_.setFromTriplets(entries.begin(), entries.end());
}

template <int dim>
double InnerField<dim>::largest(const Eigen::VectorXd& entering) const {
  constexpr double accuracy = 1e-6;
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> solver(conductance_);
  solver.setTolerance(accuracy);
  const Eigen::VectorXd field = solver.solve(entering - stored_);
  return (field.array() - stored_.dot(field)).abs().maxCoeff();
}

template bool is_dented<2>(const mesh::BlockMesh<2>&, BlockId);
template bool is_dented<3>(const mesh::BlockMesh<3>&, BlockId);
template class InnerField<2>;
template class InnerField<3>;

}  // namespace scree::thermal
