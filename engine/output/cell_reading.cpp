#include "engine/output/cell_reading.h"

#include <algorithm>

#include <Eigen/LU>

#include "engine/mesh/cells.h"

namespace scree::output {

namespace {

template <int dim>
using Weights = Eigen::Matrix<double, dim + 1, 1>;

// Of the simplex's corners, whose mean the point is.
template <int dim>
Weights<dim> weights_at(const mesh::BlockMesh<dim>& mesh, const mesh::Simplex<dim>& simplex, const Point<dim>& point) {
  Eigen::Matrix<double, dim, dim> edges;
  for (int i = 0; i < dim; ++i) edges.col(i) = mesh.nodes[simplex[i + 1]] - mesh.nodes[simplex[0]];
  Weights<dim> weights;
  weights.template tail<dim>() = edges.inverse() * (point - mesh.nodes[simplex[0]]);
  weights[0] = 1 - weights.template tail<dim>().sum();
  return weights;
}

void add(NodeId node, double weight, Stencil& stencil) {
  const auto found = std::find(stencil.nodes.begin(), stencil.nodes.end(), node);
  if (found == stencil.nodes.end()) {
    stencil.nodes.push_back(node);
    stencil.weights.push_back(weight);
  } else {
    stencil.weights[static_cast<std::size_t>(found - stencil.nodes.begin())] += weight;
  }
}

}  // namespace

template <int dim>
Stencil cell_stencil(const mesh::BlockMesh<dim>& mesh, CellId cell, const Point<dim>& point) {
  const auto simplices = mesh::both_splits(mesh, cell);
  Stencil stencil;
  for (std::size_t first = 0; first < simplices.size(); first += simplices.size() / 2) {
    std::size_t nearest = first;
    Weights<dim> weights = weights_at<dim>(mesh, simplices[first], point);
    for (std::size_t i = first + 1; i < first + simplices.size() / 2; ++i) {
      const Weights<dim> others = weights_at<dim>(mesh, simplices[i], point);
      if (others.minCoeff() <= weights.minCoeff()) continue;
      nearest = i;
      weights = others;
    }
    for (int i = 0; i <= dim; ++i) add(simplices[nearest][i], 0.5 * weights[i], stencil);
  }
  return stencil;
}

template Stencil cell_stencil<2>(const mesh::BlockMesh<2>&, CellId, const Point<2>&);
template Stencil cell_stencil<3>(const mesh::BlockMesh<3>&, CellId, const Point<3>&);

}  // namespace scree::output
