#include "engine/output/probes.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/coordinate_rounding.h"
#include "engine/mesh/cells.h"
#include "engine/output/cell_reading.h"

namespace scree::output {

namespace {

// A point on an element's boundary may miss it by the rounding of its coordinates; at least this much of an edge counts as on
// it.
constexpr double tolerance = 1e-9;

template <int dim>
using Weights = std::array<double, dim + 1>;

template <int dim>
Point<dim> interpolate(const std::array<Point<dim>, dim + 1>& corners, const Weights<dim>& weights) {
  Point<dim> point = Point<dim>::Zero();
  for (int i = 0; i <= dim; ++i) point += weights[i] * corners[i];
  return point;
}

// Weights of the point nearest to `point` in the simplex that the corners with their bit in `used` span. If its projection on
// their plane lies outside, the nearest point is on a side that faces the projection: one opposite to a negative weight.
template <int dim>
Weights<dim> nearest_weights(const std::array<Point<dim>, dim + 1>& corners, const Point<dim>& point, unsigned used) {
  std::vector<int> corner;
  for (int i = 0; i <= dim; ++i) {
    if ((used >> i & 1U) != 0) corner.push_back(i);
  }
  const auto edges = static_cast<Eigen::Index>(corner.size()) - 1;
  Eigen::MatrixXd span(dim, edges);
  for (Eigen::Index i = 0; i < edges; ++i) span.col(i) = corners[corner[i + 1]] - corners[corner[0]];
  Weights<dim> weights{};
  weights[corner[0]] = 1;
  if (edges > 0) {
    const Eigen::VectorXd solved = span.colPivHouseholderQr().solve(point - corners[corner[0]]);
    for (Eigen::Index i = 0; i < edges; ++i) weights[corner[i + 1]] = solved[i];
    weights[corner[0]] -= solved.sum();
  }
  double best = std::numeric_limits<double>::infinity();
  Weights<dim> nearest = weights;
  for (const int i : corner) {
    if (weights[i] >= 0) continue;
    const Weights<dim> side = nearest_weights<dim>(corners, point, used & ~(1U << i));
    const double distance = (interpolate<dim>(corners, side) - point).norm();
    if (distance < best) {
      best = distance;
      nearest = side;
    }
  }
  return nearest;
}

template <int dim>
struct Nearest {
  ElementId element;
  Weights<dim> weights{};
  double distance = std::numeric_limits<double>::infinity();  // [m]
};

// Every element is looked at: a handful of probes is located once per run.
template <int dim>
Nearest<dim> find_nearest(const mesh::BlockMesh<dim>& mesh, const Point<dim>& point) {
  Nearest<dim> nearest;
  for (const ElementId element : mesh.elements.ids()) {
    std::array<Point<dim>, dim + 1> corners;
    Aabb<dim> box;
    for (int i = 0; i <= dim; ++i) {
      corners[i] = mesh.nodes[mesh.elements[element][i]];
      box.extend(corners[i]);
    }
    if (box.exteriorDistance(point) >= nearest.distance) continue;
    const Weights<dim> weights = nearest_weights<dim>(corners, point, (1U << (dim + 1)) - 1);
    const double distance = (interpolate<dim>(corners, weights) - point).norm();
    if (distance >= nearest.distance) continue;
    nearest = {element, weights, distance};
    if (distance <= std::max(tolerance * box.diagonal().norm(), coordinate_rounding(box))) {
      nearest.distance = 0;
      return nearest;
    }
  }
  return nearest;
}

template <int dim>
std::string coordinates(const Point<dim>& point) {
  return fmt::format("[{}]", fmt::join(point.begin(), point.end(), ", "));
}

// The next larger number of two digits: a reach that is enough and easy to write.
double round_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return (std::floor(value / unit) + 1) * unit;
}

template <int dim>
Problem in_a_void(const ProbeSpec& spec, const mesh::BlockMesh<dim>& mesh, const Nearest<dim>& nearest) {
  Problem problem{spec.where, "output.probes." + spec.name, coordinates<dim>(spec.point.head<dim>()),
                  "must lie in a block, but there are none", ""};
  if (!nearest.element.valid()) return problem;
  const BlockId block = mesh::element_blocks(mesh)[nearest.element];
  problem.rule = fmt::format("must lie in a block; the nearest, block {} of {}, is {:.3g} m away{}", block.value(),
                             mesh.bodies[mesh.blocks[block].body].name, nearest.distance,
                             spec.reach > 0 ? fmt::format(" and its reach is {:.3g} m", spec.reach) : "");
  problem.suggestion = fmt::format("Move it, or let it move by itself with {{point: {}, reach: {:.2g} m}}", problem.value,
                                   round_up(nearest.distance));
  return problem;
}

template <int dim>
Stencil reading_of(const mesh::BlockMesh<dim>& mesh, const mesh::CellOfElement<dim>& cells, BlockId block,
                   const Point<dim>& point, const Nearest<dim>& nearest, Reading reading) {
  if (const CellId cell = cells[nearest.element]; cell.valid()) {
    Stencil stencil = reading == Reading::cubic ? cubic_stencil<dim>(mesh, block, cell, point) : Stencil{};
    return stencil.nodes.empty() ? cell_stencil<dim>(mesh, cell, point) : stencil;
  }
  const auto& nodes = mesh.elements[nearest.element];
  return {{nodes.begin(), nodes.end()}, {nearest.weights.begin(), nearest.weights.end()}};
}

}  // namespace

template <int dim>
std::vector<Probe<dim>> locate_probes(const mesh::BlockMesh<dim>& mesh, const std::vector<ProbeSpec>& specs, Reading reading) {
  const auto blocks = mesh::element_blocks(mesh);
  const mesh::CellOfElement<dim> cells(mesh);
  std::vector<Probe<dim>> probes;
  std::vector<Problem> problems;
  for (const ProbeSpec& spec : specs) {
    const Point<dim> point = spec.point.head<dim>();
    const Nearest<dim> nearest = find_nearest<dim>(mesh, point);
    if (!(nearest.distance <= spec.reach)) {
      problems.push_back(in_a_void<dim>(spec, mesh, nearest));
      continue;
    }
    Probe<dim> probe{spec.name, blocks[nearest.element], {}, point, nearest.distance, spec.exact};
    if (probe.moved > 0) {
      probe.point.setZero();
      for (int i = 0; i <= dim; ++i) probe.point += nearest.weights[i] * mesh.nodes[mesh.elements[nearest.element][i]];
    }
    probe.reading = reading_of<dim>(mesh, cells, probe.block, probe.point, nearest, reading);
    probes.push_back(std::move(probe));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return probes;
}

template <int dim>
double value_at(const Probe<dim>& probe, const Eigen::VectorXd& nodal) {
  double value = 0;
  for (std::size_t i = 0; i < probe.reading.nodes.size(); ++i) {
    value += probe.reading.weights[i] * nodal[probe.reading.nodes[i].value()];
  }
  return value;
}

template <int dim>
std::optional<double> exact_at(const Probe<dim>& probe, double time) {
  if (!probe.exact) return std::nullopt;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  place.head<dim>() = probe.point;
  return (*probe.exact)(place, time);
}

template <int dim>
std::vector<std::string> columns(const std::vector<Probe<dim>>& probes) {
  std::vector<std::string> names;
  for (const Probe<dim>& probe : probes) {
    names.push_back(probe.name);
    if (probe.exact) names.push_back(exact_column(probe.name));
  }
  return names;
}

template <int dim>
std::vector<double> column_values(const std::vector<Probe<dim>>& probes, const Eigen::VectorXd& nodal, double time) {
  std::vector<double> values;
  for (const Probe<dim>& probe : probes) {
    values.push_back(value_at(probe, nodal));
    if (const auto exact = exact_at(probe, time)) values.push_back(*exact);
  }
  return values;
}

template <int dim>
std::vector<std::string> describe(const std::vector<Probe<dim>>& probes, const mesh::BlockMesh<dim>& mesh,
                                  const Table<BlockId, BlockId>& numbers) {
  std::vector<std::string> lines;
  lines.reserve(probes.size());
  for (const Probe<dim>& probe : probes) {
    lines.push_back(fmt::format("{}: block {} of {} at {} m{}", probe.name, numbers[probe.block].value(),
                                mesh.bodies[mesh.blocks[probe.block].body].name, coordinates<dim>(probe.point),
                                probe.moved > 0 ? fmt::format(", moved by {:.3g} m", probe.moved) : ""));
  }
  return lines;
}

template std::vector<Probe<2>> locate_probes(const mesh::BlockMesh<2>&, const std::vector<ProbeSpec>&, Reading);
template std::vector<Probe<3>> locate_probes(const mesh::BlockMesh<3>&, const std::vector<ProbeSpec>&, Reading);
template double value_at(const Probe<2>&, const Eigen::VectorXd&);
template double value_at(const Probe<3>&, const Eigen::VectorXd&);
template std::optional<double> exact_at(const Probe<2>&, double);
template std::optional<double> exact_at(const Probe<3>&, double);
template std::vector<std::string> columns(const std::vector<Probe<2>>&);
template std::vector<std::string> columns(const std::vector<Probe<3>>&);
template std::vector<double> column_values(const std::vector<Probe<2>>&, const Eigen::VectorXd&, double);
template std::vector<double> column_values(const std::vector<Probe<3>>&, const Eigen::VectorXd&, double);
template std::vector<std::string> describe(const std::vector<Probe<2>>&, const mesh::BlockMesh<2>&,
                                           const Table<BlockId, BlockId>&);
template std::vector<std::string> describe(const std::vector<Probe<3>>&, const mesh::BlockMesh<3>&,
                                           const Table<BlockId, BlockId>&);

}  // namespace scree::output
