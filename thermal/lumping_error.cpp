#include "thermal/lumping_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/IterativeLinearSolvers>

#include "engine/base/check.h"
#include "thermal/exchange.h"
#include "thermal/kirchhoff_matrix.h"
#include "thermal/least_value.h"

namespace scree::thermal {

namespace {

constexpr double accuracy = 1e-3;  // of e, which is an estimate: two digits would do

// Of one of a block's patches. A row that nodes of several blocks are tied to goes by one of them: if the block does not touch
// that one, what resists the most.
PatchResistance resistance_of(const LumpedBlock& block, std::size_t patch) {
  const auto known = std::partition_point(block.patches.begin(), block.patches.end(),
                                          [patch](const LumpedPatch& one) { return one.number < patch; });
  if (known != block.patches.end() && known->number == patch) return known->resists;
  PatchResistance largest;
  for (const LumpedPatch& one : block.patches) largest = largest_of(largest, one.resists);
  return largest;
}

// Heat that flows through something, a part of it in and a part of it out [W].
struct BothWays {
  double in = 0;
  double out = 0;

  void add(double heat) { (heat > 0 ? in : out) += std::abs(heat); }
};

}  // namespace

// Through one link or place.
struct LumpingEstimate::Flow {
  double heat;         // into the block [W]
  double conductance;  // [W/K]
};

// What flows through one block's patches makes of it.
struct LumpingEstimate::Inside {
  double harder = 1;       // times what it resists at the start [-]
  double in = 0;           // sum of R |q| of what flows into it [K]
  double out = 0;          // out of it [K]
  double constricted = 0;  // max c |q| [K]

  void add(const BothWays& heat, const PatchResistance& resists) {
    in += harder * resists.bulk * heat.in;
    out += harder * resists.bulk * heat.out;
    constricted = std::max(constricted, harder * resists.constriction * std::max(heat.in, heat.out));
  }
  [[nodiscard]] double largest() const { return in + out + constricted; }
};

LumpingEstimate::LumpingEstimate(const HeatModel& model)
    : model_(model),
      blocks_(model.lumped->all()),
      harder_(model.lumped->conductivities().size(), 1),
      balance_(model),
      free_(model) {
  make_matrix();
  for (const LumpedBlock& block : blocks_) start_spread_ = std::max(start_spread_, block.start_spread);
  for (std::size_t i = 0; i < blocks_.size(); ++i) add_links(static_cast<int>(i));
  std::size_t first = model.lumped->of_blocks();
  for (std::size_t e = 0; e < model.exchanges.size(); ++e) add_places(model.exchanges[e].on, e, first, places_, patches_);
  first += model.exchanges.size();
  for (std::size_t l = 0; l < model.loads.size(); ++l) add_places(model.loads[l].on, l, first, loaded_places_, loaded_patches_);
  for (const Place& place : loaded_places_)
    steady_heat_.push_back(varies_in_time(model.loads[static_cast<std::size_t>(place.number)]) ? 0 : applied(place, 0));
}

// The rows of a neighbour need not follow each other.
void LumpingEstimate::add_links(int block) {
  const auto block_of = [this](const Link& link) { return model_.blocks[NodeId(static_cast<std::size_t>(link.other))]; };
  const LumpedBlock& of = blocks_[static_cast<std::size_t>(block)];
  const auto begin = static_cast<std::ptrdiff_t>(links_.size());
  for (SparseMatrix::InnerIterator entry(model_.conductance, of.row.value()); entry; ++entry) {
    if (entry.index() != of.row.value() && entry.value() != 0)
      links_.push_back({of.row.value(), static_cast<int>(entry.index()), -entry.value()});
  }
  std::stable_sort(links_.begin() + begin, links_.end(),
                   [&](const Link& one, const Link& other) { return block_of(one) < block_of(other); });
  for (auto first = links_.begin() + begin; first != links_.end();) {
    const BlockId other = block_of(*first);
    const auto last = std::find_if(first, links_.end(), [&](const Link& link) { return block_of(link) != other; });
    patches_.push_back({block, static_cast<int>(last - first), resistance_of(of, other.index())});
    first = last;
  }
}

// Of what differs from place to place a row has several in a row (share_rows.h), which follow each other.
void LumpingEstimate::add_places(const NodeShares& on, std::size_t number, std::size_t first, std::vector<Place>& places,
                                 std::vector<Patch>& patches) const {
  const std::vector<NodeId>& rows = on.nodes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int block = model_.lumped->position(model_.blocks[rows[i]]);
    if (block < 0) continue;
    places.push_back({rows[i].value(), static_cast<int>(number), static_cast<Eigen::Index>(i)});
    if (i > 0 && rows[i] == rows[i - 1]) {
      ++patches.back().size;
    } else {
      patches.push_back({block, 1, resistance_of(blocks_[static_cast<std::size_t>(block)], first + number)});
    }
  }
}

LumpingError LumpingEstimate::start() const {
  LumpingError error;
  error.carried = Eigen::VectorXd::Zero(model_.capacity.size());
  error.largest = start_spread_;
  return error;
}

// Where nothing sets heat free, no temperature leaves the range of those that have been, within and outside, neither of blocks
// that are lumped nor of those that are not.
double LumpingEstimate::most() const {
  return model_.loads.empty() ? range_.largest - range_.least + start_spread_ : std::numeric_limits<double>::infinity();
}

// A material may conduct worse where nothing was at the start.
void LumpingEstimate::include(const TemperatureRange& range) {
  if (range.least >= range_.least && range.largest <= range_.largest) return;
  range_ = range;
  for (const MaterialId material : harder_.ids()) {
    const LumpedConductivity& conductivity = model_.lumped->conductivities()[material];
    if (!conductivity.value.constant())
      harder_[material] = std::max(1.0, conductivity.least / least_value(conductivity.value, range));
  }
}

void LumpingEstimate::advance(const Eigen::VectorXd& temperature, const Drive& drive, double length,
                              const TemperatureRange& range, LumpingError& error) {
  include(range);
  const std::vector<Flow> through = flows(temperature, drive);
  const std::vector<Inside> within = insides(through, drive.time);
  double inside = 0;
  for (const Inside& one : within) inside = std::max(inside, one.largest());
  carry(missing(through, within), balance_.linearised(temperature, drive), length, error.carried);
  error.largest = std::max(error.largest, std::min(inside + error.carried.lpNorm<Eigen::Infinity>(), most()));
}

std::vector<LumpingEstimate::Flow> LumpingEstimate::flows(const Eigen::VectorXd& temperature, const Drive& drive) const {
  std::vector<Flow> flows;
  flows.reserve(links_.size() + places_.size());
  for (const Link& link : links_)
    flows.push_back({link.conductance * (temperature[link.other] - temperature[link.row]), link.conductance});
  for (const Place& place : places_) {
    const Exchange::Law law = model_.exchanges[static_cast<std::size_t>(place.number)].law;
    const ExchangeRates& rates = drive.exchanges[static_cast<std::size_t>(place.number)];
    const double t = temperature[place.row];
    flows.push_back({exchanged_heat(law, rates, place.at, t), exchange_slope(law, rates, place.at, t)});
  }
  return flows;
}

template <class Visit>
void LumpingEstimate::for_each_patch(const std::vector<Flow>& flows, const Visit& visit) const {
  std::span<const Flow> left = flows;
  for (const Patch& patch : patches_) {
    const auto size = static_cast<std::size_t>(patch.size);
    visit(patch, left.first(size));
    left = left.subspan(size);
  }
}

std::vector<LumpingEstimate::Inside> LumpingEstimate::insides(const std::vector<Flow>& flows, double time) const {
  std::vector<Inside> insides(blocks_.size());
  for (std::size_t i = 0; i < insides.size(); ++i) insides[i].harder = harder_[blocks_[i].material];
  for_each_patch(flows, [&](const Patch& patch, std::span<const Flow> through) {
    BothWays heat;
    for (const Flow& flow : through) heat.add(flow.heat);
    insides[static_cast<std::size_t>(patch.block)].add(heat, patch.resists);
  });
  apply(time, insides);
  return insides;
}

double LumpingEstimate::applied(const Place& place, double time) const {
  const Load& load = model_.loads[static_cast<std::size_t>(place.number)];
  return load.on.shares[static_cast<std::size_t>(place.at)] * load.density(load.on.places.col(place.at), time);
}

void LumpingEstimate::apply(double time, std::vector<Inside>& insides) const {
  std::size_t i = 0;
  for (const Patch& patch : loaded_patches_) {
    BothWays heat;
    for (const std::size_t end = i + static_cast<std::size_t>(patch.size); i < end; ++i) {
      const Place& place = loaded_places_[i];
      const bool varies = varies_in_time(model_.loads[static_cast<std::size_t>(place.number)]);
      heat.add(varies ? applied(place, time) : steady_heat_[i]);
    }
    insides[static_cast<std::size_t>(patch.block)].add(heat, patch.resists);
  }
}

// Into each row [W].
Eigen::VectorXd LumpingEstimate::missing(const std::vector<Flow>& flows, const std::vector<Inside>& insides) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(model_.capacity.size());
  auto link = links_.begin();
  auto place = places_.begin();
  for_each_patch(flows, [&](const Patch& patch, std::span<const Flow> through) {
    const Inside& inside = insides[static_cast<std::size_t>(patch.block)];
    BothWays passes;
    for (const Flow& flow : through) passes.add(flow.heat);
    for (const Flow& flow : through) {
      const double constricted = inside.harder * patch.resists.constriction * (flow.heat > 0 ? passes.in : passes.out);
      const double surface = (flow.heat > 0 ? inside.in : inside.out) + constricted;
      const double less = flow.heat == 0 ? 0 : std::copysign(flow.conductance * surface, flow.heat);
      if (link != links_.end()) {
        heat[link->row] -= less;
        heat[link++->other] += less;
      } else {
        heat[place++->row] -= less;
      }
    }
  });
  return heat;
}

// K and U have an entry each wherever one of them has one.
void LumpingEstimate::make_matrix() {
  SparseMatrix conductance = free_.block(model_.conductance);
  if (!is_symmetric(model_)) {
    const SparseMatrix unit = free_.block(model_.varying->unit_conductance);
    unit_conductance_ = 0 * conductance + unit;
    conductance += 0 * unit;
  }
  matrix_ = conductance;
  conductance_ = Eigen::Map<const Eigen::VectorXd>(matrix_.valuePtr(), matrix_.nonZeros());
  for (Eigen::Index column = 0; column < matrix_.cols(); ++column) {
    const int* const begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const int* const end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    diagonal_.push_back(std::lower_bound(begin, end, column) - matrix_.innerIndexPtr());
  }
}

// To K + U diag(k) + diag(more).
void LumpingEstimate::set_matrix(const Eigen::VectorXd& conductivity_of_all, const Eigen::VectorXd& more) {
  double* const values = matrix_.valuePtr();
  if (unit_conductance_.nonZeros() > 0) {
    const Eigen::VectorXd conductivity = free_.gather(conductivity_of_all);
    for (Eigen::Index column = 0; column < matrix_.cols(); ++column) {
      for (int i = matrix_.outerIndexPtr()[column]; i < matrix_.outerIndexPtr()[column + 1]; ++i)
        values[i] = conductance_[i] + unit_conductance_.valuePtr()[i] * conductivity[column];
    }
    for (std::size_t i = 0; i < diagonal_.size(); ++i) values[diagonal_[i]] += more[static_cast<Eigen::Index>(i)];
  } else {
    for (std::size_t i = 0; i < diagonal_.size(); ++i)
      values[diagonal_[i]] = conductance_[diagonal_[i]] + more[static_cast<Eigen::Index>(i)];
  }
}

void LumpingEstimate::carry(const Eigen::VectorXd& heat, const Linearised& at, double length, Eigen::VectorXd& carried) {
  if (free_.size() == 0) return;
  const Eigen::VectorXd stored = free_.gather(at.capacity) / length;  // 0 in the steady state
  set_matrix(at.conductivity, stored + free_.gather(at.loss));
  const Eigen::VectorXd before = free_.gather(carried);
  const auto solved = [&](auto&& solver) -> Eigen::VectorXd {
    solver.setTolerance(accuracy);
    Eigen::VectorXd after = solver.solveWithGuess(stored.cwiseProduct(before) + free_.gather(heat), before);
    if (solver.info() != Eigen::Success || !after.allFinite())
      throw RunError(
          "The error that lumped blocks make could not be estimated: its equations were not solved. Mesh all blocks");
    return after;
  };
  const bool symmetric = unit_conductance_.nonZeros() == 0;
  carried = free_.scatter(symmetric ? solved(Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper>(matrix_))
                                    : solved(Eigen::BiCGSTAB<SparseMatrix>(matrix_)));
}

}  // namespace scree::thermal
