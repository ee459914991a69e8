#include "engine/output/cubic_reading.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/LU>
#include <Eigen/QR>

#include "engine/mesh/cells.h"

namespace scree::output {

namespace {

constexpr int highest_degree = 3;
constexpr int lowest_degree = 2;
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

// Columns are the mean edges of a cell along its own axes [m].
template <int dim>
Eigen::Matrix<double, dim, dim> axes_of(const mesh::BlockMesh<dim>& mesh, const mesh::Cell& cell) {
  // Corners of a quadrilateral go around, those of a hexahedron around its bottom, then its top.
  Eigen::Matrix<double, dim, dim> axes = Eigen::Matrix<double, dim, dim>::Zero();
  const auto edge = [&](std::size_t from, std::size_t to) -> Point<dim> {
    return mesh.nodes[cell.nodes[to]] - mesh.nodes[cell.nodes[from]];
  };
  constexpr std::size_t layers = dim - 1;
  for (std::size_t bottom = 0; bottom < 4 * layers; bottom += 4) {
    axes.col(0) += (edge(bottom, bottom + 1) + edge(bottom + 3, bottom + 2)) / (2.0 * layers);
    axes.col(1) += (edge(bottom, bottom + 3) + edge(bottom + 1, bottom + 2)) / (2.0 * layers);
  }
  if constexpr (dim == 3) {
    for (std::size_t corner = 0; corner < 4; ++corner) axes.col(2) += edge(corner, corner + 4) / 4;
  }
  return axes;
}

// Nodes near the point, where they are from it, in cells, and from how many cells away they are reached.
template <int dim>
struct Surroundings {
  std::vector<NodeId> nodes;
  std::vector<Point<dim>> places;
  std::vector<int> steps;

  Surroundings(const mesh::BlockMesh<dim>& mesh, BlockId in, CellId cell, const Point<dim>& point) {
    const mesh::Block& block = mesh.blocks[in];
    const Eigen::Matrix<double, dim, dim> to_cells = axes_of<dim>(mesh, mesh.cells[cell]).inverse();
    const auto place_of = [&](NodeId node) -> Point<dim> { return to_cells * (mesh.nodes[node] - point); };
    std::vector<int> away(block.nodes.size(), too_far);
    for (const NodeId node : block.nodes) {
      if (place_of(node).cwiseAbs().maxCoeff() <= largest_reach) away[node.index() - block.nodes.first()] = not_reached;
    }
    count_steps(mesh, block, cell, away);
    for (const NodeId node : block.nodes) {
      const int step = away[node.index() - block.nodes.first()];
      if (step < 0) continue;
      nodes.push_back(node);
      places.push_back(place_of(node));
      steps.push_back(step);
    }
  }

  // Those within a number of cells.
  [[nodiscard]] Surroundings within(double reach) const {
    Surroundings near;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (places[i].cwiseAbs().maxCoeff() > reach || steps[i] > static_cast<int>(reach)) continue;
      near.nodes.push_back(nodes[i]);
      near.places.push_back(places[i]);
    }
    return near;
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

 private:
  static constexpr int not_reached = -1, too_far = -2;

  Surroundings() = default;

  // From cell to cell that have a node in common, in rounds.
  static void count_steps(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block, CellId start, std::vector<int>& away) {
    const auto of = [&](NodeId node) -> int& { return away[node.index() - block.nodes.first()]; };
    const auto corners = [&](CellId cell) {
      return std::span(mesh.cells[cell].nodes).first(mesh::corner_count(mesh.cells[cell].kind));
    };
    std::vector<CellId> near;
    for (const CellId cell : block.cells) {
      if (std::ranges::any_of(corners(cell), [&](NodeId node) { return of(node) == not_reached; })) near.push_back(cell);
    }
    const auto reach = [&](CellId cell, int step) {
      for (const NodeId node : corners(cell)) {
        if (of(node) == not_reached) of(node) = step;
      }
    };
    reach(start, 0);
    for (int step = 1; step <= static_cast<int>(largest_reach); ++step) {
      std::vector<CellId> next;
      std::erase_if(near, [&](CellId cell) {
        const bool beside = std::ranges::any_of(corners(cell), [&](NodeId node) { return of(node) >= 0; });
        if (beside) next.push_back(cell);
        return beside;
      });
      for (const CellId cell : next) reach(cell, step);
    }
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
Stencil cubic_stencil(const mesh::BlockMesh<dim>& mesh, BlockId block, CellId cell, const Point<dim>& point) {
  const Surroundings<dim> all(mesh, block, cell, point);
  const Powers<dim> most = all.powers();
  for (int degree = highest_degree; degree >= lowest_degree; --degree) {
    for (double reach = least_reach; reach <= largest_reach; ++reach) {
      Surroundings<dim> around = all.within(reach);
      std::vector<double> weights = fit<dim>(around, degree, most);
      if (!weights.empty()) return {std::move(around.nodes), std::move(weights)};
    }
  }
  return {};
}

template Stencil cubic_stencil(const mesh::BlockMesh<2>&, BlockId, CellId, const Point<2>&);
template Stencil cubic_stencil(const mesh::BlockMesh<3>&, BlockId, CellId, const Point<3>&);

}  // namespace scree::output
