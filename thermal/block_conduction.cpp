#include "thermal/block_conduction.h"

namespace scree::thermal {

namespace {

// S_0 . (x_1 - x_0) = dim V, as the face opposite to corner 0 stands dim V / |S_0| away from it.
template <int dim>
double dim_times_volume(const Corners<dim>& points, const Corners<dim>& areas) {
  return areas.col(0).dot(points.col(1) - points.col(0));
}

}  // namespace

template <int dim>
Corners<dim> corner_points(const mesh::BlockMesh<dim>& mesh, const std::array<NodeId, dim + 1>& nodes) {
  Corners<dim> points;
  for (int a = 0; a <= dim; ++a) points.col(a) = mesh.nodes[nodes[a]];
  return points;
}

template <>
Corners<2> opposite_areas<2>(const Corners<2>& points) {
  Corners<2> areas;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector2d edge = points.col((a + 2) % 3) - points.col((a + 1) % 3);
    areas.col(a) = Eigen::Vector2d(edge.y(), -edge.x());
  }
  return areas;
}

template <>
Corners<3> opposite_areas<3>(const Corners<3>& points) {
  static constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  Corners<3> areas;
  for (int a = 0; a < 4; ++a) {
    const Eigen::Vector3d first = points.col(face[a][0]);
    const Eigen::Vector3d u = points.col(face[a][1]) - first;
    const Eigen::Vector3d v = points.col(face[a][2]) - first;
    areas.col(a) = 0.5 * u.cross(v);
  }
  return areas;
}

template <int dim>
Point<dim> element_flux(const Corners<dim>& points, double conductivity, const CornerValues<dim>& temperatures) {
  const Corners<dim> areas = opposite_areas<dim>(points);
  // Differences from one corner: the areas sum to zero only to rounding, and temperatures in kelvin are large.
  const CornerValues<dim> difference = temperatures.array() - temperatures[0];
  return conductivity / dim_times_volume<dim>(points, areas) * (areas * difference);
}

template <int dim>
CornerMatrix<dim> element_conductance(const Corners<dim>& points, double conductivity) {
  const Corners<dim> areas = opposite_areas<dim>(points);
  const double scale = conductivity / (dim * dim_times_volume<dim>(points, areas));
  CornerMatrix<dim> conductance = CornerMatrix<dim>::Zero();
  for (int a = 0; a <= dim; ++a) {
    for (int b = 0; b < a; ++b) {
      const double entry = scale * areas.col(a).dot(areas.col(b));
      conductance(a, b) = entry;
      conductance(b, a) = entry;
      conductance(a, a) -= entry;
      conductance(b, b) -= entry;
    }
  }
  return conductance;
}

template Corners<2> corner_points<2>(const mesh::BlockMesh<2>&, const std::array<NodeId, 3>&);
template Corners<3> corner_points<3>(const mesh::BlockMesh<3>&, const std::array<NodeId, 4>&);
template Point<2> element_flux<2>(const Corners<2>&, double, const CornerValues<2>&);
template Point<3> element_flux<3>(const Corners<3>&, double, const CornerValues<3>&);
template CornerMatrix<2> element_conductance<2>(const Corners<2>&, double);
template CornerMatrix<3> element_conductance<3>(const Corners<3>&, double);

}  // namespace scree::thermal
