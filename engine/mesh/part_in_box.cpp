#include "engine/mesh/part_in_box.h"

#include <cmath>

namespace scree::mesh {

namespace {

// A part of a simplex that is a simplex itself.
template <int dim, int corners>
struct Part {
  Corners<dim, corners> places;
  Eigen::Matrix<double, corners, corners> weights;  // a column for each of its corners: the whole's linear functions there
};

// Of an element the root of the Gram determinant would lose half of the digits.
template <int dim, int corners>
double size(const Corners<dim, corners>& simplex) {
  constexpr int sides = corners - 1;
  const Eigen::Matrix<double, dim, sides> edges = simplex.template rightCols<sides>().colwise() - simplex.col(0);
  constexpr double factorial = sides == 3 ? 6 : sides;
  if constexpr (sides == dim) {
    return std::abs(edges.determinant()) / factorial;
  } else if constexpr (dim == 3) {
    return edges.col(0).cross(edges.col(1)).norm() / factorial;
  } else {
    return edges.norm();
  }
}

// What lies within the sides of the box from number `side` on: the lower ones of all axes, then the upper ones. An edge that
// crosses a side is cut there, which makes two simplices of one, until none crosses it.
template <int dim, int corners>
Eigen::Array<double, corners, 1> shares_within(const Part<dim, corners>& part, const Aabb<dim>& box, double rounding,
                                               int side) {
  if (side == 2 * dim) return size<dim, corners>(part.places) * part.weights.rowwise().mean().array();
  const int axis = side % dim;
  const double sign = side < dim ? 1 : -1;
  const double plane = side < dim ? box.min()[axis] : box.max()[axis];
  Eigen::Index inner = 0;
  Eigen::Index outer = 0;
  Eigen::Array<double, 1, corners> depth = sign * (part.places.row(axis).array() - plane);
  depth = (depth.abs() <= rounding).select(0, depth);
  const double most = depth.maxCoeff(&inner);
  const double least = depth.minCoeff(&outer);
  if (least >= 0) return shares_within<dim, corners>(part, box, rounding, side + 1);
  if (most <= 0) return Eigen::Array<double, corners, 1>::Zero();
  const double way = least / (least - most);
  Part<dim, corners> with_inner = part;
  with_inner.places.col(outer) += way * (part.places.col(inner) - part.places.col(outer));
  with_inner.places(axis, outer) = plane;
  with_inner.weights.col(outer) += way * (part.weights.col(inner) - part.weights.col(outer));
  Part<dim, corners> with_outer = part;
  with_outer.places.col(inner) = with_inner.places.col(outer);
  with_outer.weights.col(inner) = with_inner.weights.col(outer);
  return shares_within<dim, corners>(with_inner, box, rounding, side) +
         shares_within<dim, corners>(with_outer, box, rounding, side);
}

// Where a plane cuts an element that reaches to its inner side: a corner of the cut per column, by its weights of the
// element's. Four of them (two and two corners beside the plane) are such that the first three and the last three are two
// triangles.
template <int dim>
using Cut = Eigen::Matrix<double, dim + 1, Eigen::Dynamic, 0, dim + 1, 4>;

template <int dim>
Cut<dim> cut_at(const Eigen::Array<double, 1, dim + 1>& depth) {
  Cut<dim> cut(dim + 1, 0);
  const auto add = [&cut](const Eigen::Vector<double, dim + 1>& weights) {
    cut.conservativeResize(Eigen::NoChange, cut.cols() + 1);
    cut.rightCols(1) = weights;
  };
  if ((depth <= 0).all()) return cut;
  using Weights = Eigen::Vector<double, dim + 1>;
  for (Eigen::Index inner = 0; inner <= dim; ++inner) {
    if (depth[inner] == 0) add(Weights::Unit(inner));
    if (depth[inner] <= 0) continue;
    for (Eigen::Index outer = 0; outer <= dim; ++outer) {
      if (depth[outer] >= 0) continue;
      const double way = depth[inner] / (depth[inner] - depth[outer]);
      add((1 - way) * Weights::Unit(inner) + way * Weights::Unit(outer));
    }
  }
  return cut;
}

}  // namespace

template <int dim, int corners>
Eigen::Array<double, corners, 1> shares_in_box(const Corners<dim, corners>& simplex, const Aabb<dim>& box, double rounding) {
  const Aabb<dim> extent{simplex.rowwise().minCoeff(), simplex.rowwise().maxCoeff()};
  if (box.contains(extent)) return Eigen::Array<double, corners, 1>::Constant(size<dim, corners>(simplex) / corners);
  return shares_within<dim, corners>({simplex, Eigen::Matrix<double, corners, corners>::Identity()}, box, rounding, 0);
}

template <int dim>
Eigen::Array<double, dim + 1, 1> shares_on_side(const Corners<dim, dim + 1>& element, const Aabb<dim>& box, int axis, bool high,
                                                double rounding) {
  const double plane = high ? box.max()[axis] : box.min()[axis];
  Eigen::Array<double, 1, dim + 1> depth = (high ? -1 : 1) * (element.row(axis).array() - plane);
  depth = (depth.abs() <= rounding).select(0, depth);
  const Cut<dim> cut = cut_at<dim>(depth);
  Eigen::Array<double, dim + 1, 1> shares = Eigen::Array<double, dim + 1, 1>::Zero();
  for (Eigen::Index first = 0; first + dim <= cut.cols(); ++first) {
    const Eigen::Matrix<double, dim + 1, dim> weights = cut.template middleCols<dim>(first);
    Corners<dim, dim> face = element * weights;
    face.row(axis).setConstant(plane);
    shares += (weights * shares_in_box<dim, dim>(face, box, rounding).matrix()).array();
  }
  return shares;
}

template Eigen::Array<double, 3, 1> shares_on_side<2>(const Corners<2, 3>&, const Aabb<2>&, int, bool, double);
template Eigen::Array<double, 4, 1> shares_on_side<3>(const Corners<3, 4>&, const Aabb<3>&, int, bool, double);

template Eigen::Array<double, 2, 1> shares_in_box<2, 2>(const Corners<2, 2>&, const Aabb<2>&, double);
template Eigen::Array<double, 3, 1> shares_in_box<2, 3>(const Corners<2, 3>&, const Aabb<2>&, double);
template Eigen::Array<double, 3, 1> shares_in_box<3, 3>(const Corners<3, 3>&, const Aabb<3>&, double);
template Eigen::Array<double, 4, 1> shares_in_box<3, 4>(const Corners<3, 4>&, const Aabb<3>&, double);

}  // namespace scree::mesh
