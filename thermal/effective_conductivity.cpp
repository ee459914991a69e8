#include "thermal/effective_conductivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/coordinate_rounding.h"
#include "engine/mesh/cells.h"
#include "engine/mesh/part_in_box.h"
#include "thermal/block_conduction.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_solver.h"
#include "thermal/joined_rows.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

template <int dim>
std::string span_of(const Aabb<dim>& box) {
  return fmt::format("from ({:g}) to ({:g}) m", fmt::join(box.min(), ", "), fmt::join(box.max(), ", "));
}

// The trace of the tensor over its dimension [W/m/K].
template <int dim>
double mean_over_axes(const Conductivity& conductivity) {
  return conductivity.value.constant().value() * conductivity.ratio.head<dim>().mean();
}

// Steady temperatures of the blocks in and around a window, under temperatures and flows of its own.
template <int dim>
class Sample {
 public:
  Sample(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const HeatModel& model,
         const Aabb<dim>& window)
      : mesh_(mesh),
        materials_(materials),
        model_(model),
        window_(window),
        rounding_(std::max(1e-9 * window.diagonal().norm(), coordinate_rounding(window))) {
    model_.fixed_hold.clear();
    model_.holds.clear();
    model_.loads.clear();
    model_.exchanges.clear();
    inside_ = parts_in(mesh, window);
    find_cuts();
    if (model.varying) {
      throw InputError(problem("heat.effective_conductivity", "a material whose properties depend on temperature",
                               "must have constant properties", "Give the values at the temperature of interest"));
    }
    rows_.resize(static_cast<std::size_t>(model.capacity.size()));
    group_.resize(rows_.size());
    for (const NodeId node : mesh.nodes.ids()) rows_[model.rows[node].index()] = node;
  }

  [[nodiscard]] EffectiveConductivity<dim> measure() {
    EffectiveConductivity<dim> result;
    for (const PartInside<dim>& part : inside_) result.solid_fraction += part.volume / window_.volume();
    result.volume_mean = volume_mean();
    result.upper = linear_temperature();
    for (int axis = 0; axis < dim; ++axis) result.along[axis] = between_plates(axis);
    result.lower = uniform_flux();
    return result;
  }

 private:
  using Tensor = typename EffectiveConductivity<dim>::Tensor;

  [[nodiscard]] const Material& material_of(const PartInside<dim>& part) const {
    return materials_[mesh_.bodies[mesh_.blocks[part.block].body].material];
  }

  [[nodiscard]] double volume_mean() const {
    double sum = 0;
    for (const PartInside<dim>& part : inside_) sum += mean_over_axes<dim>(*material_of(part).conductivity) * part.volume;
    return sum / window_.volume();
  }

  [[nodiscard]] double above_low(NodeId node, int axis) const { return mesh_.nodes[node][axis] - window_.min()[axis]; }
  [[nodiscard]] double below_high(NodeId node, int axis) const { return window_.max()[axis] - mesh_.nodes[node][axis]; }
  [[nodiscard]] double depth(NodeId node, int axis) const { return std::min(above_low(node, axis), below_high(node, axis)); }
  [[nodiscard]] bool beyond(NodeId node, int axis) const { return depth(node, axis) <= rounding_; }

  // Holds the rows whose node `held` chooses, and one row of every group of blocks that would hold none.
  template <class Held>
  void hold(const Held& held) {
    mesh::DisjointSets groups(rows_.size());
    join_rows(model_.conductance, groups);
    for (std::size_t row = 0; row < rows_.size(); ++row) group_[row] = groups.root(row);
    std::vector<char> grounded(rows_.size(), 0);
    std::vector<char> fixed(rows_.size(), 0);
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      fixed[row] = held(rows_[row]) ? 1 : 0;
      if (fixed[row] != 0) grounded[group_[row]] = 1;
    }
    model_.fixed_nodes.clear();
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      char& has_ground = grounded[group_[row]];
      if (fixed[row] == 0 && has_ground != 0) continue;
      has_ground = 1;
      model_.fixed_nodes.emplace_back(row);
    }
    free_.emplace(model_);
    solver_.emplace(model_, *free_, LinearSolver::automatic, use_of_steady_state);
    Linearised no_loss;
    no_loss.loss = Eigen::VectorXd::Zero(model_.capacity.size());
    solver_->prepare_steady(no_loss);
  }

  // Of each row the load that flows do not take away [W]. Flows are worked out one by one, so that both ends of each lose and
  // get the same: by a product with the matrix stiff joints would lose and make heat.
  [[nodiscard]] Eigen::VectorXd imbalance(const Eigen::VectorXd& temperature, const Eigen::VectorXd& load) const {
    Eigen::VectorXd left = load;
    for (Eigen::Index row = 0; row < left.size(); ++row) {
      for (SparseMatrix::InnerIterator entry(model_.conductance, row); entry; ++entry)
        left[row] -= entry.value() * (temperature[entry.index()] - temperature[row]);
    }
    return left;
  }

  struct Solution {
    Eigen::VectorXd temperature;  // steady [K]
    double last_correction;       // its largest change by the last refinement, as a part of it [-]
  };

  // For the values of the held nodes and the loads of all [W], refined as far as that helps.
  [[nodiscard]] Solution solve(const Eigen::VectorXd& held_values, const Eigen::VectorXd& load) const {
    constexpr double rounding = 1e-13;
    Solution found{Eigen::VectorXd::Zero(load.size()), std::numeric_limits<double>::infinity()};
    for (const NodeId node : model_.fixed_nodes) found.temperature[node.value()] = held_values[node.value()];
    while (found.last_correction > rounding) {
      const Eigen::VectorXd change = free_->scatter(solver_->solve(free_->gather(imbalance(found.temperature, load))));
      if (change.isZero(0)) return {found.temperature, 0};
      const Eigen::VectorXd refined = found.temperature + change;
      const double correction = change.cwiseAbs().maxCoeff() / refined.cwiseAbs().maxCoeff();
      if (correction > found.last_correction / 2) break;
      found = {refined, correction};
    }
    return found;
  }

  // Integral of the flux over parts of elements [W m].
  [[nodiscard]] Point<dim> flux_over(const std::vector<PartInside<dim>>& parts, const Eigen::VectorXd& temperature) const {
    Point<dim> sum = Point<dim>::Zero();
    for (const PartInside<dim>& part : parts) {
      const auto along = gradient<dim>([&](int corner, int axis) { return mesh_.nodes[part.nodes[corner]][axis]; },
                                       [&](int corner) { return temperature[model_.rows[part.nodes[corner]].value()]; });
      const Conductivity& conductivity = *material_of(part).conductivity;
      const Tensor tensor = *conductivity.value.constant() * conductivity_ratios<dim>(conductivity, mesh_.blocks[part.block]);
      sum += part.volume * flux<dim>(tensor, Point<dim>(along.data()));
    }
    return sum;
  }

  // Mean over the window, voids at 0 [W/m2].
  [[nodiscard]] Point<dim> mean_flux(const Eigen::VectorXd& temperature) const {
    return flux_over(inside_, temperature) / window_.volume();
  }

  // What lies between the planes of two sides, beside the window, too.
  [[nodiscard]] std::vector<PartInside<dim>> between_planes(int axis) const {
    Aabb<dim> layer = window_;
    for (const Point<dim>& node : mesh_.nodes) layer.extend(node);
    layer.min()[axis] = window_.min()[axis];
    layer.max()[axis] = window_.max()[axis];
    return parts_in(mesh_, layer);
  }

  // Against the axis into the nodes that are held on and below its low side [W].
  [[nodiscard]] double flow_into_low_side(const Eigen::VectorXd& temperature, int axis) const {
    const Eigen::VectorXd coming = imbalance(temperature, Eigen::VectorXd::Zero(temperature.size()));
    double sum = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      if (above_low(rows_[row], axis) <= rounding_) sum += coming[static_cast<Eigen::Index>(row)];
    }
    return sum;
  }

  // Of an element that a side of the window cuts: of each corner the integral over the cut of its linear function [m2].
  struct Cut {
    mesh::Simplex<dim> nodes;
    Eigen::Array<double, dim + 1, 1> shares;
  };

  [[nodiscard]] static std::size_t side_of(int axis, bool high) { return static_cast<std::size_t>(2 * axis) + (high ? 1 : 0); }

  void find_cuts() {
    for (const mesh::Block& block : mesh_.blocks) {
      mesh::for_each_simplex(mesh_, block, [&](const mesh::Simplex<dim>& nodes, double weight) {
        const auto corners = mesh::corners_of(mesh_, nodes);
        for (int axis = 0; axis < dim; ++axis) {
          for (const bool high : {false, true}) {
            const auto shares = mesh::shares_on_side<dim>(corners, window_, axis, high, rounding_);
            if (shares.sum() > 0) cuts_[side_of(axis, high)].push_back({nodes, weight * shares});
          }
        }
      });
    }
  }

  // How far the blocks on a side are in the mean from the temperature that nodes beyond it are held at [K].
  [[nodiscard]] double mean_excess(const Eigen::VectorXd& excess, int axis, bool high) const {
    double sum = 0;
    double area = 0;
    for (const Cut& cut : cuts_[side_of(axis, high)]) {
      for (int corner = 0; corner <= dim; ++corner) sum += cut.shares[corner] * excess[model_.rows[cut.nodes[corner]].value()];
      area += cut.shares.sum();
    }
    return area > 0 ? sum / area : 0;
  }

  // Mean over the window of the gradient along `axis` of temperatures of which nodes beyond are held at coordinates along
  // `held` [K/m]. Where a side cuts elements, heat has come from those nodes to it, and the window is left with less than 1.
  [[nodiscard]] double mean_gradient(const Eigen::VectorXd& temperature, int axis, int held) const {
    const Eigen::VectorXd excess = temperature - coordinates(held);
    const double more = mean_excess(excess, axis, true) - mean_excess(excess, axis, false);
    return (axis == held ? 1 : 0) + more / window_.sizes()[axis];
  }

  [[nodiscard]] Eigen::VectorXd coordinates(int axis) const {
    Eigen::VectorXd values(model_.capacity.size());
    for (std::size_t row = 0; row < rows_.size(); ++row) values[static_cast<Eigen::Index>(row)] = above_low(rows_[row], axis);
    return values;
  }

  [[nodiscard]] Tensor linear_temperature() {
    hold([&](NodeId node) {
      for (int axis = 0; axis < dim; ++axis) {
        if (beyond(node, axis)) return true;
      }
      return false;
    });
    const Eigen::VectorXd no_load = Eigen::VectorXd::Zero(model_.capacity.size());
    Tensor flux;
    Tensor gradient;
    for (int held = 0; held < dim; ++held) {
      const Eigen::VectorXd temperature = solve(coordinates(held), no_load).temperature;
      flux.col(held) = mean_flux(temperature);
      for (int axis = 0; axis < dim; ++axis) gradient(axis, held) = mean_gradient(temperature, axis, held);
    }
    return -flux * gradient.inverse();
  }

  [[nodiscard]] double between_plates(int axis) {
    hold([&](NodeId node) { return beyond(node, axis); });
    const Eigen::VectorXd temperature = solve(coordinates(axis), Eigen::VectorXd::Zero(model_.capacity.size())).temperature;
    // The flux in elements that a side cuts is one between nodes that are held, and not what passes on. Their flow is; the
    // fluxes tell the window's share of it.
    const double of_all = flux_over(between_planes(axis), temperature)[axis];
    if (of_all == 0) return 0;
    const double share = flux_over(inside_, temperature)[axis] / of_all;
    const double area = window_.volume() / window_.sizes()[axis];
    return share * flow_into_low_side(temperature, axis) / area / mean_gradient(temperature, axis, axis);
  }

  struct Side {
    FaceId face;
    int axis;
    double sign;  // of the outward normal
    double area;  // [m2]
  };

  // Whether a face lies on a side of the window and looks out of it.
  [[nodiscard]] bool is_on(const mesh::WeightedFace<dim>& face, int axis, bool high) const {
    for (const NodeId node : face.nodes) {
      if (std::abs(high ? below_high(node, axis) : above_low(node, axis)) > rounding_) return false;
      for (int other = 0; other < dim; ++other) {
        if (other != axis && depth(node, other) < -rounding_) return false;
      }
    }
    return (mesh::area_vector<dim>(mesh_, face.nodes)[axis] > 0) == high;
  }

  // The faces on the window's sides; nothing if they leave a part of a side open.
  [[nodiscard]] std::optional<std::vector<Side>> sides(const Table<FaceId, mesh::WeightedFace<dim>>& faces) const {
    std::vector<Side> found;
    Eigen::Matrix<double, dim, 2> covered = Eigen::Matrix<double, dim, 2>::Zero();
    for (const FaceId f : faces.ids()) {
      for (int axis = 0; axis < dim; ++axis) {
        for (int high = 0; high < 2; ++high) {
          if (!is_on(faces[f], axis, high == 1)) continue;
          found.push_back({f, axis, high == 1 ? 1.0 : -1.0, faces[f].weight * mesh::face_area(mesh_, faces[f])});
          covered(axis, high) += found.back().area;
        }
      }
    }
    for (int axis = 0; axis < dim; ++axis) {
      const double whole = window_.volume() / window_.sizes()[axis];
      if ((covered.row(axis).array() - whole).abs().maxCoeff() > 1e-6 * whole) return std::nullopt;
    }
    return found;
  }

  // Whether every group of blocks that are joined gives off what it takes in. Where one does not, no uniform flux passes.
  [[nodiscard]] bool passes_through(const Eigen::VectorXd& load) const {
    std::vector<double> left(rows_.size(), 0.0);
    for (std::size_t row = 0; row < rows_.size(); ++row) left[group_[row]] += load[static_cast<Eigen::Index>(row)];
    const double largest =
        std::abs(*std::max_element(left.begin(), left.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    return largest <= 1e-9 * load.lpNorm<1>();
  }

  // Whether blocks outside the window are joined with the faces on its sides: heat would go round it.
  [[nodiscard]] bool goes_round(const std::vector<Side>& sides, const Table<FaceId, mesh::WeightedFace<dim>>& faces) const {
    std::vector<bool> passed(rows_.size());
    const auto group_of = [&](NodeId node) { return group_[model_.rows[node].index()]; };
    for (const Side& side : sides) passed[group_of(faces[side.face].nodes[0])] = true;
    const auto ids = mesh_.nodes.ids();
    return std::any_of(ids.begin(), ids.end(), [&](NodeId node) {
      double least = depth(node, 0);
      for (int axis = 1; axis < dim; ++axis) least = std::min(least, depth(node, axis));
      return least < -rounding_ && passed[group_of(node)];
    });
  }

  [[nodiscard]] std::optional<Tensor> uniform_flux() {
    const auto faces = mesh::weighted_faces(mesh_);
    const auto found = sides(faces);
    if (!found) return std::nullopt;
    hold([](NodeId) { return false; });
    if (goes_round(*found, faces)) return std::nullopt;
    Tensor resistivity = Tensor::Zero();  // [m K/W]
    for (int axis = 0; axis < dim; ++axis) {
      Eigen::VectorXd load = Eigen::VectorXd::Zero(model_.capacity.size());
      for (const Side& side : *found) {
        if (side.axis != axis) continue;
        for (const NodeId node : faces[side.face].nodes) load[model_.rows[node].value()] -= side.sign * side.area / dim;
      }
      if (!passes_through(load)) return std::nullopt;
      const auto [temperature, last_correction] = solve(Eigen::VectorXd::Zero(load.size()), load);
      if (last_correction > 1e-6) return std::nullopt;  // lost in rounding
      for (const Side& side : *found) {
        double mean = 0;
        for (const NodeId node : faces[side.face].nodes) mean += temperature[model_.rows[node].value()] / dim;
        resistivity(side.axis, axis) -= side.sign * side.area * mean / window_.volume();
      }
    }
    return resistivity.inverse();
  }

  const mesh::BlockMesh<dim>& mesh_;
  const Table<MaterialId, Material>& materials_;
  HeatModel model_;
  Aabb<dim> window_;
  double rounding_;  // [m]
  std::vector<PartInside<dim>> inside_;
  std::array<std::vector<Cut>, std::size_t{2} * dim> cuts_;  // by side_of()
  std::vector<NodeId> rows_;                                 // a node of each row: tied ones share one (tied_nodes.h)
  std::vector<std::size_t> group_;                           // of each row: the row that stands for all it is joined with
  std::optional<FreeNodes> free_;
  std::optional<HeatSolver> solver_;
};

}  // namespace

template <int dim>
std::vector<PartInside<dim>> parts_in(const mesh::BlockMesh<dim>& mesh, const Aabb<dim>& window) {
  std::vector<PartInside<dim>> parts;
  for (const BlockId b : mesh.blocks.ids()) {
    mesh::for_each_simplex(mesh, mesh.blocks[b], [&](const mesh::Simplex<dim>& nodes, double weight) {
      const double volume = mesh::shares_in_box<dim, dim + 1>(mesh::corners_of(mesh, nodes), window, 0).sum();
      if (volume > 0) parts.push_back({nodes, b, weight * volume});
    });
  }
  if (!parts.empty()) return parts;
  Aabb<dim> extent;
  for (const Point<dim>& node : mesh.nodes) extent.extend(node);
  throw InputError(problem("heat.effective_conductivity", "a window " + span_of(window),
                           "must hold a part of at least one element", "The blocks reach " + span_of(extent)));
}

template <int dim>
EffectiveConductivity<dim> effective_conductivity(const mesh::BlockMesh<dim>& mesh,
                                                  const Table<MaterialId, Material>& materials, const HeatModel& model,
                                                  const Aabb<dim>& window) {
  return Sample<dim>(mesh, materials, model, window).measure();
}

template std::vector<PartInside<2>> parts_in<2>(const mesh::BlockMesh<2>&, const Aabb<2>&);
template std::vector<PartInside<3>> parts_in<3>(const mesh::BlockMesh<3>&, const Aabb<3>&);
template EffectiveConductivity<2> effective_conductivity<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                                            const HeatModel&, const Aabb<2>&);
template EffectiveConductivity<3> effective_conductivity<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                                            const HeatModel&, const Aabb<3>&);

}  // namespace scree::thermal
