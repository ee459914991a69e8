#include "thermal/lumping_error.h"

#include <algorithm>
#include <cmath>

#include <Eigen/IterativeLinearSolvers>

#include "thermal/exchange.h"

namespace scree::thermal {

namespace {

constexpr double accuracy = 1e-3;  // of e, which is an estimate: two digits would do

}  // namespace

// Through the patches of one block [W].
struct LumpingEstimate::Flows {
  double in = 0;
  double out = 0;
  double largest = 0;

  void add(double heat) {
    (heat > 0 ? in : out) += std::abs(heat);
    largest = std::max(largest, std::abs(heat));
  }
};

LumpingEstimate::LumpingEstimate(const HeatModel& model)
    : model_(model), blocks_(model.lumped->all()), balance_(model, Sums::plain), free_(model) {
  conductance_ = free_.block(model.conductance);
  if (model.varying && model.varying->unit_conductance.nonZeros() > 0) {
    unit_conductance_ = free_.block(model.varying->unit_conductance);
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
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Flows& of = through[i];
    inside = std::max(inside, blocks_[i].bulk * (of.in + of.out) + blocks_[i].constriction * of.largest);
  }
  carry(missing(temperature, drive, through), balance_.linearised(temperature, drive), length, error.carried);
  error.largest = std::max(error.largest, inside + error.carried.lpNorm<Eigen::Infinity>());
}

// A neighbour's rows follow each other, as its nodes do.
template <class Visit>
void LumpingEstimate::for_each_patch(const Eigen::VectorXd& temperature, const Drive& drive, const Visit& visit) const {
  const SparseMatrix& k = model_.conductance;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const int row = blocks_[i].row.value();
    const int end = k.outerIndexPtr()[row + 1];
    for (int first = k.outerIndexPtr()[row], last = first; first < end; first = last) {
      const BlockId neighbour = model_.blocks[NodeId(static_cast<std::size_t>(k.innerIndexPtr()[first]))];
      double heat = 0;
      double conductance = 0;
      for (; last < end; ++last) {
        const int other = k.innerIndexPtr()[last];
        if (model_.blocks[NodeId(static_cast<std::size_t>(other))] != neighbour) break;
        if (other == row) continue;
        conductance -= k.valuePtr()[last];
        heat -= k.valuePtr()[last] * (temperature[other] - temperature[row]);
      }
      if (conductance > 0) visit(i, heat, conductance, first, last);
    }
  }
  for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
    const Exchange& exchange = model_.exchanges[e];
    for (std::size_t n = 0; n < exchange.on.nodes.size(); ++n) {
      const NodeId row = exchange.on.nodes[n];
      const int position = model_.lumped->position(model_.blocks[row]);
      if (position < 0) continue;
      const auto at = static_cast<Eigen::Index>(n);
      const ExchangeRates& rates = drive.exchanges[e];
      const double t = temperature[row.value()];
      visit(static_cast<std::size_t>(position), exchanged_heat(exchange.law, rates, at, t),
            exchange_slope(exchange.law, rates, at, t), 0, 0);
    }
  }
}

std::vector<LumpingEstimate::Flows> LumpingEstimate::flows(const Eigen::VectorXd& temperature, const Drive& drive) const {
  std::vector<Flows> result(blocks_.size());
  for_each_patch(temperature, drive, [&](std::size_t i, double heat, double, int, int) { result[i].add(heat); });
  for (std::size_t i = 0; i < blocks_.size(); ++i) result[i].add(drive.load[blocks_[i].row.value()]);
  return result;
}

// Into each row [W].
Eigen::VectorXd LumpingEstimate::missing(const Eigen::VectorXd& temperature, const Drive& drive,
                                         const std::vector<Flows>& flows) const {
  const SparseMatrix& k = model_.conductance;
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(temperature.size());
  for_each_patch(temperature, drive, [&](std::size_t i, double through, double conductance, int first, int last) {
    const int row = blocks_[i].row.value();
    const double same_way = through > 0 ? flows[i].in : flows[i].out;
    const double surface = blocks_[i].bulk * same_way + blocks_[i].constriction * std::abs(through);
    const double less = std::copysign(conductance * surface, through);
    heat[row] -= less;
    for (int entry = first; entry < last; ++entry) {
      const int other = k.innerIndexPtr()[entry];
      if (other != row) heat[other] -= less * k.valuePtr()[entry] / conductance;  // K_ij < 0
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
  carried = free_.scatter(after);
}

}  // namespace scree::thermal
