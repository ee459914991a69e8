#include "thermal/inner_resistance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace scree::thermal {

namespace {

// Symmetric X with X A + A X = right, A symmetric, positive definite and given by its eigenvalues and eigenvectors.
template <int dim>
Tensor<dim> lyapunov(const Eigen::SelfAdjointEigenSolver<Tensor<dim>>& a, const Tensor<dim>& right) {
  Tensor<dim> x = a.eigenvectors().transpose() * right * a.eigenvectors();
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) x(i, j) /= a.eigenvalues()[i] + a.eigenvalues()[j];
  }
  return a.eigenvectors() * x * a.eigenvectors().transpose();
}

}  // namespace

template <int dim>
InnerResistance<dim>::InnerResistance(const mesh::BlockMesh<dim>& mesh, BlockId block, const Tensor<dim>& conductivity)
    : mesh_(mesh),
      block_(mesh.blocks[block]),
      conductivity_(conductivity),
      lowest_conductivity_(Eigen::SelfAdjointEigenSolver<Tensor<dim>>(conductivity, Eigen::EigenvaluesOnly).eigenvalues()[0]) {
  for (const ElementId e : block_.elements) {
    const double volume = mesh::element_volume(mesh, e);
    for (const NodeId node : mesh.elements[e]) centroid_ += volume / (dim + 1) * mesh.nodes[node];
    volume_ += volume;
  }
  centroid_ /= volume_;
  for (const ElementId e : block_.elements) {
    const double share = mesh::element_volume(mesh, e) / ((dim + 1) * (dim + 2));
    Point<dim> sum = Point<dim>::Zero();
    for (const NodeId node : mesh.elements[e]) {
      const Point<dim> corner = mesh.nodes[node] - centroid_;
      moments_ += share * corner * corner.transpose();
      sum += corner;
    }
    moments_ += share * sum * sum.transpose();
  }
  if (is_dented(mesh_, block)) field_.emplace(mesh_, block_, conductivity_);
  const Tensor<dim> root = conductivity_.llt().matrixL();
  inverse_root_ = root.inverse();
  scaled_moments_.compute(inverse_root_ * moments_ * inverse_root_.transpose());
}

template <int dim>
void InnerResistance<dim>::add_at_node(NodeId node, double weight, PatchMoments<dim>& patch) const {
  if (!field_) return;
  if (patch.at_nodes.size() == 0) patch.at_nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(block_.nodes.size()));
  patch.at_nodes[static_cast<Eigen::Index>(node.index() - block_.nodes.first())] += weight;
}

template <int dim>
void InnerResistance<dim>::add(NodeId node, double weight, PatchMoments<dim>& patch) const {
  patch.add(mesh_.nodes[node] - centroid_, weight);
  add_at_node(node, weight, patch);
}

template <int dim>
void InnerResistance<dim>::add(const contact::Stencil<dim>& point, double weight, PatchMoments<dim>& patch) const {
  patch.add(point_of(mesh_, point) - centroid_, weight);
  contact::for_each_weight(point, [&](NodeId node, double share) { add_at_node(node, share * weight, patch); });
}

template <int dim>
double InnerResistance<dim>::bulk(const PatchMoments<dim>& patch) const {
  if (patch.weight == 0) return 0;
  if (field_) return field_->largest(patch.at_nodes / patch.weight);
  const Point<dim> slope = conductivity_.llt().solve(patch.first / patch.weight) / volume_;
  const Tensor<dim> right = 0.5 * (patch.second / patch.weight - moments_ / volume_);
  const Tensor<dim> scaled = lyapunov<dim>(scaled_moments_, inverse_root_ * right * inverse_root_.transpose());
  const Tensor<dim> bend = inverse_root_.transpose() * scaled * inverse_root_;
  const double mean = (bend * moments_).trace() / volume_;
  double largest = 0;
  for (const NodeId node : block_.nodes) {
    const Point<dim> x = mesh_.nodes[node] - centroid_;
    largest = std::max(largest, std::abs(slope.dot(x) + x.dot(bend * x) - mean));
  }
  return largest;
}

template <int dim>
double InnerResistance<dim>::radius_of(double volume) {
  using std::numbers::pi;
  return dim == 3 ? std::cbrt(3 * volume / (4 * pi)) : std::sqrt(volume / pi);
}

template <int dim>
double InnerResistance<dim>::constriction_within(double volume) const {
  using std::numbers::pi;
  if (volume >= volume_) return 0;
  const double inner = radius_of(volume), outer = radius_of(volume_);
  if constexpr (dim == 2) return std::log(outer / inner) / (2 * pi * lowest_conductivity_);
  return 3 * (1 / inner - 1 / outer) / (8 * pi * lowest_conductivity_);
}

template <int dim>
double InnerResistance<dim>::constriction(double area) const {
  using std::numbers::pi;
  const double lowest = lowest_conductivity_, radius = radius_of(volume_);
  const double surface = dim == 3 ? 4 * pi * radius * radius : 2 * pi * radius;
  if (area >= surface) return 0;
  if constexpr (dim == 2) return std::log(1 / std::sin(0.5 * pi * area / surface)) / (pi * lowest);
  const double of_surface = std::sqrt(area / surface);  // r/b
  return std::pow(1 - of_surface, 1.5) / (4 * lowest * std::sqrt(area / pi));
}

template class InnerResistance<2>;
template class InnerResistance<3>;

}  // namespace scree::thermal
