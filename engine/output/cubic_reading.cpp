#include "engine/output/cubic_reading.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace scree::output {

namespace {

constexpr int highest_degree = 3;
// Cells around the point, a little more so that nodes right there are among them.
constexpr double least_reach = 2.01;
constexpr double largest_reach = 4.01;
// Columns of the fit that are this dependent on the others are taken for dependent.
constexpr double rank_threshold = 1e-6;
// Nodes that are closer than this along an axis, in cells, are of one layer.
constexpr double layer_thickness = 1e-3;

template <int dim>
using Powers = std::array<int, dim>;

// Exponents of the monomials up to a degree and, of each axis, up to `most`; the constant one first.
template <int dim>
std::vector<Powers<dim>> exponents(int degree, const Powers<dim>& most) {
  std::vector<Powers<dim>> all;
  for (int sum = 0; sum <= degree; ++sum) {
    for (int i = 0; i <= sum; ++i) {
      if constexpr (dim == 2) {
        all.push_back({sum - i, i});
      } else {
        for (int j = 0; i + j <= sum; ++j) all.push_back({sum - i - j, i, j});
      }
    }
  }
  std::erase_if(all, [&](const Powers<dim>& powers) {
    return !std::equal(powers.begin(), powers.end(), most.begin(), [](int power, int bound) { return power <= bound; });
  });
  return all;
}

// Nodes near the point and where they are from it, in cells.
template <int dim>
struct Surroundings {
  std::vector<NodeId> nodes;
  std::vector<Point<dim>> places;

  Surroundings(const mesh::BlockMesh<dim>& mesh, BlockId block, const Point<dim>& point, const Point<dim>& extent,
               double reach) {
    for (const NodeId node : mesh.blocks[block].nodes) {
      const Point<dim> place = (mesh.nodes[node] - point).cwiseQuotient(extent);
      if (place.cwiseAbs().maxCoeff() > reach) continue;
      nodes.push_back(node);
      places.push_back(place);
    }
  }

  // The powers of each axis that its layers of nodes determine: across a plate of one cell a line.
  [[nodiscard]] Powers<dim> powers() const {
    Powers<dim> most;
    for (int axis = 0; axis < dim; ++axis) {
      std::vector<double> heights;
      for (const Point<dim>& place : places) heights.push_back(place[axis]);
      std::sort(heights.begin(), heights.end());
      int layers = heights.empty() ? 0 : 1;
      for (std::size_t i = 1; i < heights.size(); ++i) layers += heights[i] - heights[i - 1] > layer_thickness ? 1 : 0;
      most[static_cast<std::size_t>(axis)] = layers - 1;
    }
    return most;
  }
};

// The weights of the nodes in the constant term of the polynomial; none if the nodes do not determine it.
template <int dim>
std::vector<double> fit(const Surroundings<dim>& around, int degree, const Powers<dim>& most) {
  const auto monomials = exponents<dim>(degree, most);
  const auto rows = static_cast<Eigen::Index>(around.nodes.size());
  const auto columns = static_cast<Eigen::Index>(monomials.size());
  if (rows < columns) return {};
  Eigen::VectorXd weight(rows);
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Point<dim>& place = around.places[static_cast<std::size_t>(row)];
    weight[row] = std::exp(-place.squaredNorm());
    for (Eigen::Index column = 0; column < columns; ++column) {
      matrix(row, column) = weight[row];
      for (int axis = 0; axis < dim; ++axis) {
        for (int power = monomials[static_cast<std::size_t>(column)][axis]; power > 0; --power)
          matrix(row, column) *= place[axis];
      }
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows, columns);
  qr.setThreshold(rank_threshold);
  qr.compute(matrix);
  if (qr.rank() < columns) return {};
  // The first row of the pseudo-inverse P R^-1 Q^T.
  Eigen::VectorXd first = Eigen::VectorXd::Zero(rows);
  first.head(columns) = qr.colsPermutation().transpose() * Eigen::VectorXd::Unit(columns, 0);
  qr.matrixR().topRows(columns).triangularView<Eigen::Upper>().transpose().solveInPlace(first.head(columns));
  first.applyOnTheLeft(qr.householderQ());
  const Eigen::VectorXd weights = first.cwiseProduct(weight);
  return {weights.begin(), weights.end()};
}

}  // namespace

template <int dim>
Stencil cubic_stencil(const mesh::BlockMesh<dim>& mesh, BlockId block, const Point<dim>& point, const Point<dim>& extent) {
  const Powers<dim> most = Surroundings<dim>(mesh, block, point, extent, largest_reach).powers();
  for (int degree = highest_degree; degree > 0; --degree) {
    for (double reach = least_reach; reach <= largest_reach; ++reach) {
      Surroundings<dim> around(mesh, block, point, extent, reach);
      std::vector<double> weights = fit<dim>(around, degree, most);
      if (!weights.empty()) return {std::move(around.nodes), std::move(weights)};
    }
  }
  return {};
}

template Stencil cubic_stencil(const mesh::BlockMesh<2>&, BlockId, const Point<2>&, const Point<2>&);
template Stencil cubic_stencil(const mesh::BlockMesh<3>&, BlockId, const Point<3>&, const Point<3>&);

}  // namespace scree::output
