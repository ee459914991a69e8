#include "engine/mesh/volume_in_box.h"

#include <cmath>

namespace scree::mesh {

namespace {

template <int dim>
using Simplex = Eigen::Matrix<double, dim, dim + 1>;  // a corner per column

template <int dim>
double volume(const Simplex<dim>& simplex) {
  const Eigen::Matrix<double, dim, dim> edges = simplex.template rightCols<dim>().colwise() - simplex.col(0);
  return std::abs(edges.determinant()) / (dim == 2 ? 2 : 6);
}

// What lies within the sides of the box from number `side` on: the lower ones of all axes, then the upper ones. An edge that
// crosses a side is cut there, which makes two simplices of one, until none crosses it.
template <int dim>
double volume_within(const Simplex<dim>& simplex, const Aabb<dim>& box, int side) {
  if (side == 2 * dim) return volume<dim>(simplex);
  const int axis = side % dim;
  const double sign = side < dim ? 1 : -1;
  const double plane = side < dim ? box.min()[axis] : box.max()[axis];
  Eigen::Index inner = 0;
  Eigen::Index outer = 0;
  const Eigen::Array<double, 1, dim + 1> depth = sign * (simplex.row(axis).array() - plane);
  const double most = depth.maxCoeff(&inner);
  const double least = depth.minCoeff(&outer);
  if (most <= 0) return 0;
  if (least >= 0) return volume_within<dim>(simplex, box, side + 1);
  Point<dim> cut = simplex.col(outer) + least / (least - most) * (simplex.col(inner) - simplex.col(outer));
  cut[axis] = plane;
  Simplex<dim> with_inner = simplex;
  with_inner.col(outer) = cut;
  Simplex<dim> with_outer = simplex;
  with_outer.col(inner) = cut;
  return volume_within<dim>(with_inner, box, side) + volume_within<dim>(with_outer, box, side);
}

}  // namespace

template <int dim>
double volume_in_box(const BlockMesh<dim>& mesh, ElementId element, const Aabb<dim>& box) {
  Simplex<dim> simplex;
  for (int corner = 0; corner <= dim; ++corner) simplex.col(corner) = mesh.nodes[mesh.elements[element][corner]];
  const Aabb<dim> extent{simplex.rowwise().minCoeff(), simplex.rowwise().maxCoeff()};
  if (!box.intersects(extent)) return 0;
  if (box.contains(extent)) return volume<dim>(simplex);
  return volume_within<dim>(simplex, box, 0);
}

template double volume_in_box<2>(const BlockMesh<2>&, ElementId, const Aabb<2>&);
template double volume_in_box<3>(const BlockMesh<3>&, ElementId, const Aabb<3>&);

}  // namespace scree::mesh
