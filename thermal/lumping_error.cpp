#include "thermal/lumping_error.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/IterativeLinearSolvers>

#include "engine/base/check.h"
#include "thermal/exchange.h"
#include "thermal/kirchhoff_matrix.h"

namespace scree::thermal {

namespace {

constexpr double accuracy = 1e-3;  // of e, which is an estimate: two digits would do

}  // namespace

struct LumpingEstimate::Patch {
  std::size_t position = 0;  // of its block among the lumped ones
  double heat = 0;           // into the block [W]
  double conductance = 0;    // [W/K]
  PatchResistance resists;
  std::span<const int> entries = {};  // in K's column of the block that belong to it; none for an exchange
};

// What flows through one block's patches makes of it.
struct LumpingEstimate::Flows {
  double in = 0;           // sum of R |q| of what flows into it [K]
  double out = 0;          // out of it [K]
  double constricted = 0;  // max c |q| [K]

  void add(double heat, const PatchResistance& resists) {
    (heat > 0 ? in : out) += resists.bulk * std::abs(heat);
    constricted = std::max(constricted, resists.constriction * std::abs(heat));
  }
};

LumpingEstimate::LumpingEstimate(const HeatModel& model)
    : model_(model), blocks_(model.lumped->all()), balance_(model), free_(model) {
  conductance_ = free_.block(model.conductance);
  if (!is_symmetric(model)) unit_conductance_ = free_.block(model.varying->unit_conductance);
  // A neighbour's rows need not follow each other.
  for (const LumpedBlock& block : blocks_) {
    const auto begin = static_cast<std::ptrdiff_t>(entries_.size());
    const int* column = model.conductance.outerIndexPtr() + block.row.value();
    for (int entry = column[0]; entry < column[1]; ++entry) entries_.push_back(entry);
    std::stable_sort(entries_.begin() + begin, entries_.end(),
                     [&](int one, int other) { return neighbour_in(one) < neighbour_in(other); });
  }
}

LumpingError LumpingEstimate::start() const {
  LumpingError error;
  error.carried = Eigen::VectorXd::Zero(model_.capacity.size());
  for (const LumpedBlock& block : blocks_) error.largest = std::max(error.largest, block.start_spread);
  return error;
}

void LumpingEstimate::advance(const Eigen::VectorXd& temperature, const Drive& drive, double length,
                              LumpingError& error) const {
  const std::vector<Flows> through = flows(temperature, drive);
  double inside = 0;
  for (const Flows& of : through) inside = std::max(inside, of.in + of.out + of.constricted);
  carry(missing(temperature, drive, through), balance_.linearised(temperature, drive), length, error.carried);
  error.largest = std::max(error.largest, inside + error.carried.lpNorm<Eigen::Infinity>());
}

template <class Visit>
void LumpingEstimate::for_each_patch(const Eigen::VectorXd& temperature, const Drive& drive, const Visit& visit) const {
  const SparseMatrix& k = model_.conductance;
  std::span<const int> left = entries_;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const int row = blocks_[i].row.value();
    for (auto in_column = k.outerIndexPtr()[row + 1] - k.outerIndexPtr()[row]; in_column > 0;) {
      Patch patch{i, 0, 0, blocks_[i].contact};
      const BlockId neighbour = neighbour_in(left.front());
      std::size_t count = 0;
      for (; in_column > 0 && neighbour_in(left[count]) == neighbour; ++count, --in_column) {
        const int other = k.innerIndexPtr()[left[count]];
        if (other == row) continue;
        patch.conductance -= k.valuePtr()[left[count]];
        patch.heat -= k.valuePtr()[left[count]] * (temperature[other] - temperature[row]);
      }
      patch.entries = left.first(count);
      left = left.subspan(count);
      if (patch.conductance > 0) visit(patch);
    }
  }
  for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
    const Exchange& exchange = model_.exchanges[e];
    const ExchangeRates& rates = drive.exchanges[e];
    for (std::size_t n = 0; n < exchange.on.nodes.size(); ++n) {
      const NodeId row = exchange.on.nodes[n];
      const int position = model_.lumped->position(model_.blocks[row]);
      if (position < 0) continue;
      const auto at = static_cast<Eigen::Index>(n);
      const double t = temperature[row.value()];
      visit(Patch{static_cast<std::size_t>(position), exchanged_heat(exchange.law, rates, at, t),
                  exchange_slope(exchange.law, rates, at, t), blocks_[static_cast<std::size_t>(position)].exchange});
    }
  }
}

BlockId LumpingEstimate::neighbour_in(int entry) const {
  return model_.blocks[NodeId(static_cast<std::size_t>(model_.conductance.innerIndexPtr()[entry]))];
}

std::vector<LumpingEstimate::Flows> LumpingEstimate::flows(const Eigen::VectorXd& temperature, const Drive& drive) const {
  std::vector<Flows> result(blocks_.size());
  for_each_patch(temperature, drive, [&](const Patch& patch) { result[patch.position].add(patch.heat, patch.resists); });
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const double net = drive.load[blocks_[i].row.value()], size = drive.load_sizes[blocks_[i].row.value()];
    result[i].add(0.5 * (size + net), blocks_[i].load);
    result[i].add(-0.5 * (size - net), blocks_[i].load);
  }
  return result;
}

// Into each row [W].
Eigen::VectorXd LumpingEstimate::missing(const Eigen::VectorXd& temperature, const Drive& drive,
                                         const std::vector<Flows>& flows) const {
  const SparseMatrix& k = model_.conductance;
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(temperature.size());
  for_each_patch(temperature, drive, [&](const Patch& patch) {
    const LumpedBlock& block = blocks_[patch.position];
    const Flows& of_block = flows[patch.position];
    const double surface = (patch.heat > 0 ? of_block.in : of_block.out) + patch.resists.constriction * std::abs(patch.heat);
    const double less = std::copysign(patch.conductance * surface, patch.heat);
    heat[block.row.value()] -= less;
    for (const int entry : patch.entries) {
      const int other = k.innerIndexPtr()[entry];
      if (other != block.row.value()) heat[other] -= less * k.valuePtr()[entry] / patch.conductance;  // K_ij < 0
    }
  });
  return heat;
}

void LumpingEstimate::carry(const Eigen::VectorXd& heat, const Linearised& at, double length, Eigen::VectorXd& carried) const {
  if (free_.size() == 0) return;
  const Eigen::VectorXd stored = free_.gather(at.capacity) / length;  // 0 in the steady state
  SparseMatrix matrix = conductance_;
  if (unit_conductance_.nonZeros() > 0) matrix += unit_conductance_ * free_.gather(at.conductivity).col(0).asDiagonal();
  matrix.diagonal() += stored + free_.gather(at.loss);
  Eigen::BiCGSTAB<SparseMatrix> solver(matrix);
  solver.setTolerance(accuracy);
  const Eigen::VectorXd before = free_.gather(carried);
  const Eigen::VectorXd after = solver.solveWithGuess(stored.cwiseProduct(before) + free_.gather(heat), before);
  if (solver.info() != Eigen::Success || !after.allFinite())
    throw RunError("The error that lumped blocks make could not be estimated: its equations were not solved. Mesh all blocks");
  carried = free_.scatter(after);
}

}  // namespace scree::thermal
