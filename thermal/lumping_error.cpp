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

// Where a block touches another one. A row that nodes of several blocks are tied to goes by one of them: if the block does not
// touch that one, what resists the most.
PatchResistance resistance_beside(const LumpedBlock& block, BlockId other) {
  const auto patch = std::partition_point(block.contacts.begin(), block.contacts.end(),
                                          [&](const ContactPatch& one) { return one.with < other; });
  if (patch != block.contacts.end() && patch->with == other) return patch->resists;
  PatchResistance largest;
  for (const ContactPatch& one : block.contacts) largest = largest_of(largest, one.resists);
  return largest;
}

}  // namespace

struct LumpingEstimate::Patch {
  std::size_t position = 0;  // of its block among the lumped ones
  double heat = 0;           // into the block [W]
  double conductance = 0;    // [W/K]
  PatchResistance resists;
  std::span<const Link> links = {};  // that make it; none for an exchange
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
  for (std::size_t i = 0; i < blocks_.size(); ++i) add_neighbours(static_cast<int>(i));
}

// The rows of a neighbour need not follow each other.
void LumpingEstimate::add_neighbours(int position) {
  const auto block_of = [this](const Link& link) { return model_.blocks[NodeId(static_cast<std::size_t>(link.row))]; };
  const int row = blocks_[static_cast<std::size_t>(position)].row.value();
  const auto begin = static_cast<std::ptrdiff_t>(links_.size());
  for (SparseMatrix::InnerIterator entry(model_.conductance, row); entry; ++entry)
    if (entry.index() != row) links_.push_back({static_cast<int>(entry.index()), entry.value()});
  std::stable_sort(links_.begin() + begin, links_.end(),
                   [&](const Link& one, const Link& other) { return block_of(one) < block_of(other); });
  for (auto first = links_.begin() + begin; first != links_.end();) {
    const auto last = std::find_if(first, links_.end(), [&](const Link& link) { return block_of(link) != block_of(*first); });
    Neighbour neighbour{position, static_cast<int>(last - first)};
    neighbour.resists = resistance_beside(blocks_[static_cast<std::size_t>(position)], block_of(*first));
    std::for_each(first, last, [&](const Link& link) { neighbour.conductance -= link.entry; });
    neighbours_.push_back(neighbour);
    first = last;
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
  std::span<const Link> left = links_;
  for (const Neighbour& neighbour : neighbours_) {
    const LumpedBlock& block = blocks_[static_cast<std::size_t>(neighbour.position)];
    Patch patch{static_cast<std::size_t>(neighbour.position), 0, neighbour.conductance, neighbour.resists,
                left.first(static_cast<std::size_t>(neighbour.links))};
    left = left.subspan(patch.links.size());
    const double own = temperature[block.row.value()];
    for (const Link& link : patch.links) patch.heat -= link.entry * (temperature[link.row] - own);
    if (patch.conductance > 0) visit(patch);
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
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(temperature.size());
  for_each_patch(temperature, drive, [&](const Patch& patch) {
    const LumpedBlock& block = blocks_[patch.position];
    const Flows& of_block = flows[patch.position];
    const double surface = (patch.heat > 0 ? of_block.in : of_block.out) + patch.resists.constriction * std::abs(patch.heat);
    const double less = std::copysign(patch.conductance * surface, patch.heat);
    heat[block.row.value()] -= less;
    for (const Link& link : patch.links) heat[link.row] -= less * link.entry / patch.conductance;  // entries are negative
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
