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
Tensor<dim> conductivity_ratios(const Conductivity& conductivity, const mesh::Block& block) {
  if (conductivity.isotropic()) return conductivity.ratio[0] * Tensor<dim>::Identity();
  const Eigen::Matrix3d axes = (block.orientation * conductivity.axes).toRotationMatrix();
  const Eigen::Matrix3d tensor = axes * conductivity.ratio.asDiagonal() * axes.transpose();
  return tensor.topLeftCorner<dim, dim>();
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
CornerMatrix<dim> element_conductance(const Corners<dim>& points, const Tensor<dim>& conductivity) {
  const Corners<dim> areas = opposite_areas<dim>(points);
  const double scale = 1 / (dim * dim_times_volume<dim>(points, areas));
  CornerMatrix<dim> conductance = CornerMatrix<dim>::Zero();
  for (int a = 0; a <= dim; ++a) {
    for (int b = 0; b < a; ++b) {
      const double entry = scale * areas.col(a).dot(conductivity * areas.col(b));
      conductance(a, b) = entry;
      conductance(b, a) = entry;
      conductance(a, a) -= entry;
      conductance(b, b) -= entry;
    }
  }
  return conductance;
}

template Tensor<2> conductivity_ratios<2>(const Conductivity&, const mesh::Block&);
template Tensor<3> conductivity_ratios<3>(const Conductivity&, const mesh::Block&);
template CornerMatrix<2> element_conductance<2>(const Corners<2>&, const Tensor<2>&);
template CornerMatrix<3> element_conductance<3>(const Corners<3>&, const Tensor<3>&);

}  // namespace scree::thermal
