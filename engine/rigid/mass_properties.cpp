#include "engine/rigid/mass_properties.h"

#include <Eigen/Eigenvalues>

namespace scree::rigid {

MassProperties mass_properties(const mesh::BlockMesh<3>& mesh, BlockId block, double density) {
  MassProperties result;
  const auto& elements = mesh.blocks[block].elements;
  double volume = 0;
  for (const ElementId e : elements) {
    const double part = mesh::element_volume(mesh, e);
    for (const NodeId node : mesh.elements[e]) result.centre += part / 4 * mesh.nodes[node];
    volume += part;
  }
  result.centre /= volume;
  // Second moments of a tetrahedron with corners v_i and their sum s: V/20 (sum v_i v_i^T + s s^T), exact for polynomials of
  // degree 2.
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const ElementId e : elements) {
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const NodeId node : mesh.elements[e]) {
      const Eigen::Vector3d corner = mesh.nodes[node] - result.centre;
      products += corner * corner.transpose();
      sum += corner;
    }
    moments += mesh::element_volume(mesh, e) / 20 * (products + sum * sum.transpose());
  }
  const Eigen::Matrix3d inertia = density * (moments.trace() * Eigen::Matrix3d::Identity() - moments);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
  Eigen::Matrix3d rotation = axes.eigenvectors();
  if (rotation.determinant() < 0) rotation.col(0) = -rotation.col(0);
  result.mass = density * volume;
  result.inertia = axes.eigenvalues();
  result.principal = Eigen::Quaterniond(rotation).normalized();
  return result;
}

}  // namespace scree::rigid
