// The scheme of rkl2.h, along the tangent at the start of each step: with C, J and F of the temperatures T0 there,
//   C D' = F(T0, t) - J x(D),    H(T1) - H(T0) = C D(h),
// H the enthalpy, and x(D) what the temperature has become more by, along a parabola where c depends on it (bent_storage.h).
// Where nothing depends on temperature that is the equation itself, and T1 = T0 + D(h). Where something does, it leaves out
// what else bends within a step, O(h^3) as the scheme's own error, and the largest eigenvalue that sets the number of stages is
// known beforehand and holds for the whole step. Heat that flows along the tangent is what the ledger books, so it closes: the
// mean that it is given is of x.
//
// With x = D the nodes of stiff joints would end beside each other where they belong together, each by what its own enthalpy
// bends: half a millikelvin, of which the flow at the next step's start, and the estimate of rkl2.h with it, makes 8 mK.
//
// Local error, beside that of rkl2.h: the tangent leaves out h^3/6 F''(D, D), and F(T1) - (F(T0) - J x) is half of F''(D, D),
// so -h/3 C^-1 times that is added; of temperatures that are held, which may be back by then, the mean of it over the step. A
// coefficient that changes in time bends F in the same way. Where c has a kink on the way temperatures are beside x(D) within
// the step, too (BentStorage::stray): J times their mean counts, of which no more than twice the largest can come about. Errors
// are of T1, C(T0)/C(T1) times what they are of D. The global error is carried by the scheme itself as a second column of each
// product.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "engine/base/huge_pages.h"
#include "thermal/bent_storage.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/moving_drive.h"
#include "thermal/rkl2.h"
#include "thermal/stable_step.h"
#include "thermal/time_scheme.h"
#include "thermal/watched_mean.h"

namespace scree::thermal {

namespace {

using namespace rkl2;

using Columns = MovingDrive::Columns;

class StabilisedScheme : public TimeScheme {
 public:
  StabilisedScheme(const HeatModel& model, StableSteps stable)
      : model_(model),
        drives_(model),
        balance_(model, Sums::plain),
        moving_(model),
        storage_(model),
        stable_(stable.at_start().step),
        sharing_(model.shared_capacity ? &*model.shared_capacity : nullptr, Sums::plain),
        watched_(ledger_nodes(model)) {
    linearise({0, model.initial, {}});
    if (!has_constant_properties(model)) changing_ = std::move(stable);
    held_conductivity_bends_ = conducts_by_temperature() && holds_vary_in_time(model);
    resize({&start_, &newer_, &older_});
    if (!sharing_.empty()) resize({&rates_, &beside_});
    if (conducts_by_temperature()) resize({&beside_, &conducted_});
    if (storage_) resize({&warmer_, &next_warmer_});
  }

  Step step(const Instant& from, double length) override {
    if (changing_) follow(from, length);
    const int stages = stages_for(storage_ ? (1 + BentStorage::most_bend) * length : length, stable_);
    start(from, length);
    if (!moving_.empty()) moving_.fit(balance_, drives_, from.time, length, from.temperature, inverse_);
    for_each_stretch([&](Eigen::Index row, Eigen::Index rows) {
      older_.middleRows(row, rows).setZero();
      newer_.middleRows(row, rows) = first_coefficient(stages) * start_.middleRows(row, rows);
    });
    moving_.hold(newer_, part_at(1, stages));
    if (storage_) warm();
    WatchedMean mean(watched_);
    advance_all(stages, length, mean);
    rates(increments(), length, older_);
    moving_.heat(older_, -1, 1);  // h (L x - C^-1 g) at the end
    Step result = along_tangent(from, estimate_of(stages));
    result.stages = stages_of(from, length, stages, mean.added_to(from.temperature, stages));
    if (changing_) leave_tangent(from, length, estimate_of(stages), result);
    return result;
  }

  // The local error of a short step is h^3 T'''/18 at most.
  double first_step(const Instant& from, double allowed) override {
    if (changing_) follow(from, 0);
    start({from.time, from.temperature, Eigen::VectorXd::Zero(inverse_.size())}, 1);
    newer_ = start_;
    for (int order = 2; order <= 3; ++order) {
      rates(newer_, 1, older_);
      older_.swap(newer_);
    }
    const double largest = newer_.col(0).lpNorm<Eigen::Infinity>();
    return largest > 0 ? std::cbrt(18 * allowed / largest) : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] std::vector<Look> drive_quadrature(double) const override {
    return {{0, 1.0 / 6}, {0.5, 2.0 / 3}, {1, 1.0 / 6}};
  }
  [[nodiscard]] double safety() const override { return 1; }
  [[nodiscard]] Sums sums() const override { return Sums::plain; }
  [[nodiscard]] double cost_exponent() const override { return 0.5; }
  [[nodiscard]] std::string name() const override {
    if (!changing_) return fmt::format("{} with steps from the tolerance; stable Euler step {:.3g} s", scheme_name, stable_);
    return fmt::format(
        "{} along the tangent at each step's start, steps from the tolerance; stable Euler step {:.3g} s at first", scheme_name,
        changing_->at_start().step);
  }

 private:
  static constexpr const char* scheme_name = "RKL2 (stabilised explicit, second order)";

  void resize(std::initializer_list<Columns*> all) const {
    for (Columns* columns : all) {
      columns->resize(inverse_.size(), 2);
      prefer_huge_pages(columns->data(), static_cast<std::size_t>(columns->size()) * sizeof(double));
    }
  }

  void linearise(const Instant& at) {
    linear_ = balance_.linearised(at.temperature, drives_.at(at.time));
    inverse_ = inverse_capacity(model_, linear_.capacity);
  }

  void follow(const Instant& from, double length) {
    linearise(from);
    stable_ = changing_->at(linear_);
    if (!storage_) return;
    // No further than temperatures have been: beyond, a formula over temperature need not have a value.
    Eigen::VectorXd expected;
    if (from.rate.size() > 0) expected = from.reached.nearest(from.temperature + length * from.rate);
    storage_.fit(balance_, from.temperature, linear_.capacity, expected);
  }

  // Calls visit(first row, number of rows) on all threads for all rows.
  template <class Visit>
  void for_each_stretch(const Visit& visit) const {
    for_short_chunks(static_cast<std::size_t>(start_.rows()), [&](Chunk chunk) {
      visit(static_cast<Eigen::Index>(chunk.begin), static_cast<Eigen::Index>(chunk.end - chunk.begin));
    });
  }

  // What the ledger is given: flows are linear, so the mean's are the same at all three times of the drive.
  [[nodiscard]] std::vector<Stage> stages_of(const Instant& from, double length, int stages, Eigen::VectorXd mean) const {
    std::optional<double> tangent;
    if (changing_) tangent = from.time;
    if (moving_.empty()) return {{1, from.time + length, std::move(mean), tangent}};
    const DriveWeights weights = drive_weights(stages);
    return {{weights.start, from.time, mean, tangent},
            {weights.middle, from.time + 0.5 * length, mean, tangent},
            {weights.end, from.time + length, mean, tangent}};
  }

  // Change and errors of the step that has been taken.
  Step along_tangent(const Instant& from, double estimate) const {
    Step result;
    for (Eigen::VectorXd* each : {&result.change, &result.error, &result.local}) each->resize(start_.rows());
    for_each_shortly(start_.rows(), [&](Eigen::Index row) {
      result.local[row] = inverse_[row] > 0 ? estimate * (start_(row, 0) - newer_(row, 0) - 0.5 * older_(row, 0)) : 0;
      result.change[row] = newer_(row, 0);
      result.error[row] = from.error[row] + newer_(row, 1) + result.local[row];
    });
    return result;
  }

  // By how much more heat leaves each node than along the tangent, for what held temperatures make of k on their way: the mean
  // over the step less the third of that at its end which the estimate counts [W]. A swing may be back by then.
  [[nodiscard]] std::optional<Eigen::VectorXd> beside_held(const Instant& from, double length) {
    if (!held_conductivity_bends_) return std::nullopt;
    constexpr int looks = 8;
    const VaryingProperties& properties = *model_.varying;
    Eigen::VectorXd beside = Eigen::VectorXd::Zero(from.temperature.size());
    const auto look_at = [&](double part, double weight) {
      const Drive& drive = drives_.at(from.time + part * length);
      for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
        const NodeId node = model_.fixed_nodes[i];
        const Curve& k = properties.conductivity[static_cast<std::size_t>(properties.material[node])];
        const double begin = from.temperature[node.value()], now = drive.fixed[static_cast<Eigen::Index>(i)];
        const double along = linear_.conductivity[node.value()] * (now - begin);
        beside[node.value()] += weight * (k.integral(now) - k.integral(begin) - along);
      }
    };
    for (int i = 0; i < looks; ++i) look_at((i + 0.5) / looks, 1.0 / looks);
    look_at(1, -1.0 / 3);
    return balance_.unit_flows().leaving(beside);
  }

  // What the step's change is of the enthalpy, it becomes of the temperature, and so do the errors.
  void leave_tangent(const Instant& from, double length, double estimate, Step& result) {
    const Drive& drive = drives_.at(from.time + length);
    const Eigen::VectorXd heat = linear_.capacity.cwiseProduct(newer_.col(0));
    result.change =
        balance_.temperature_after(from.temperature, heat, from.temperature + increments().col(0)) - from.temperature;
    for (const NodeId node : model_.fixed_nodes) result.change[node.value()] = newer_(node.value(), 0);
    const Eigen::VectorXd end = from.temperature + result.change;
    const Eigen::VectorXd heating = balance_.heating(end, drive);
    const Eigen::VectorXd capacity = capacity_at(model_, end);
    const auto beside = beside_held(from, length);
    const Eigen::VectorXd stray =
        storage_ ? storage_.stray(balance_, from.temperature, newer_.col(0), heat, result.change, from.negligible)
                 : Eigen::VectorXd();
    const Eigen::VectorXd lost = stray.size() > 0 ? balance_.lost(stray, linear_) : stray;
    const double most = stray.size() > 0 ? 2 * stray.lpNorm<Eigen::Infinity>() : 0;
    for_each_shortly(start_.rows(), [&](Eigen::Index row) {
      if (inverse_[row] == 0) return;
      const double along = start_(row, 0) - older_(row, 0);
      const double bent = length * inverse_[row] * heating[row] - along;
      double local = estimate * (start_(row, 0) - newer_(row, 0) - 0.5 * older_(row, 0)) - bent / 3;
      if (beside) local += length * inverse_[row] * (*beside)[row];
      if (lost.size() > 0) local += std::clamp(length * inverse_[row] * lost[row], -most, most);
      const double shrinks = linear_.capacity[row] / capacity[row];
      result.error[row] = shrinks * (from.error[row] + newer_(row, 1) + local);
      result.local[row] = shrinks * local;
    });
  }

  // h C^-1 F of the temperatures, and of the error, which nothing drives: the flows of both in one product.
  void start(const Instant& from, double length) {
    for_each_stretch([&](Eigen::Index row, Eigen::Index rows) {
      newer_.middleRows(row, rows) << from.temperature.segment(row, rows), from.error.segment(row, rows);
    });
    const Eigen::VectorXd driven = balance_.driven(from.temperature, drives_.at(from.time));
    if (conducts_by_temperature()) {
      older_.col(0) = balance_.conducted(from.temperature);
      older_.col(1) = linear_.conductivity.cwiseProduct(from.error);
      lay_beside(older_);
    }
    for_each_flow(newer_, [&](int row, const Pair& flow) {
      const double scale = length * inverse_[row];
      start_(row, 0) = scale * (driven[row] - flow[0]);
      start_(row, 1) = -scale * (flow[1] + linear_.loss[row] * newer_(row, 1));
    });
    share(start_);
  }

  // h L x.
  void rates(const Columns& x, double length, Columns& result) {
    if (conducts_by_temperature()) {
      conduct(x);
      lay_beside(conducted_);
    }
    for_each_flow(x, [&](int row, const Pair& flow) {
      const double scale = length * inverse_[row];
      for (int c = 0; c < 2; ++c) result(row, c) = scale * (flow[c] + linear_.loss[row] * x(row, c));
    });
    share(result);
  }

  // The flows of K, and with them those that lie beside.
  template <class Use>
  void for_each_flow(const Columns& x, const Use& use) {
    if (conducts_by_temperature()) {
      balance_.flows().for_each_flow<2>(x.data(),
                                        [&](int row, const double* flow) { use(row, ConstPair(flow) + pair(beside_, row)); });
    } else {
      balance_.flows().for_each_flow<2>(x.data(), [&](int row, const double* flow) { use(row, ConstPair(flow)); });
    }
  }

  void conduct(const Columns& x) {
    for_each_stretch([&](Eigen::Index row, Eigen::Index rows) {
      conducted_.middleRows(row, rows) = linear_.conductivity.segment(row, rows).asDiagonal() * x.middleRows(row, rows);
    });
  }

  // Those of U, where a conductivity depends on temperature.
  void lay_beside(const Columns& conducted) {
    balance_.unit_flows().for_each_flow<2>(conducted.data(), [&](int row, const double* flow) {
      Eigen::Map<Pair>(beside_.data() + 2 * static_cast<std::ptrdiff_t>(row)) = ConstPair(flow);
    });
  }

  // Space of fourth order: rates become (1 + C^-1 B) times themselves (fourth_order.h), by a second product each. Nothing to do
  // in second order.
  void share(Columns& rates) {
    if (sharing_.empty()) return;
    sharing_.for_each_flow<2>(rates.data(), [&](int row, const double* flow) {
      Eigen::Map<Pair>(beside_.data() + 2 * static_cast<std::ptrdiff_t>(row)) =
          pair(rates, row) + inverse_[row] * ConstPair(flow);
    });
    rates.swap(beside_);
  }

  // Stages 2 to `stages`, each in the place of the one before the last.
  void advance_all(int stages, double length, WatchedMean& mean) {
    if (!sharing_.empty()) return advance_by_rates(stages, length, mean);
    if (conducts_by_temperature()) conduct(increments());
    const auto advance_these = [&](auto conducts, auto stores) { advance<conducts.value, stores.value>(stages, length, mean); };
    if (conducts_by_temperature()) {
      storage_ ? advance_these(std::true_type(), std::true_type()) : advance_these(std::true_type(), std::false_type());
    } else {
      storage_ ? advance_these(std::false_type(), std::true_type()) : advance_these(std::false_type(), std::false_type());
    }
  }

  // Whether a conductivity, and whether a specific heat depends on temperature.
  template <bool conducts, bool stores>
  void advance(int stages, double length, WatchedMean& mean) {
    for (int j = 2; j <= stages; ++j) {
      const Coefficients with = coefficients(j, stages);
      if constexpr (conducts) lay_beside(conducted_);
      const Columns& warmer = stores ? warmer_ : newer_;
      balance_.flows().for_each_part<2>(warmer.data(), [&](int first, int rows) {
        mean.advance(j, with, warmer, first, rows);
        return
            [with, scale = with.product * length, newer = newer_.data(), older = older_.data(), start = start_.data(),
             loss = linear_.loss.data(), inverse = inverse_.data(), beside = beside_.data(), conducted = conducted_.data(),
             conductivity = linear_.conductivity.data(), warmer = warmer.data(),
             next = stores ? next_warmer_.data() : older_.data(), bend = storage_.slope().data()](int row, const double* flow) {
              const std::ptrdiff_t at = 2 * static_cast<std::ptrdiff_t>(row);
              Eigen::Map<Pair> increment(older + at);
              Pair leaving = ConstPair(flow) + loss[row] * ConstPair(warmer + at);
              if constexpr (conducts) leaving += ConstPair(beside + at);
              increment = with.mu * ConstPair(newer + at) + with.nu * increment - (scale * inverse[row]) * leaving +
                          with.start * ConstPair(start + at);
              if constexpr (stores) {
                next[at] = BentStorage::rise(bend[row], increment[0]);
                next[at + 1] = increment[1];
              }
              if constexpr (conducts) Eigen::Map<Pair>(conducted + at) = conductivity[row] * ConstPair(next + at);
            };
      });
      move(older_, with, j, stages);
      older_.swap(newer_);
      if constexpr (stores) warmer_.swap(next_warmer_);
    }
  }

  // What the nodes are warmer by, and their errors: D, or x of it.
  [[nodiscard]] const Columns& increments() const { return storage_ ? warmer_ : newer_; }

  // x of D.
  void warm() {
    for_each_shortly(start_.rows(), [&](Eigen::Index row) { warm(newer_, row, warmer_); });
  }
  void warm(const Columns& heat, Eigen::Index row, Columns& warmer) const {
    warmer.row(row) << BentStorage::rise(storage_.slope()[row], heat(row, 0)), heat(row, 1);
  }

  // What drives stage j beside what does from the step's start on.
  void move(Columns& increment, const Coefficients& with, int j, int stages) {
    if (moving_.empty()) return;
    moving_.heat(increment, with.product, part_at(j - 1, stages));
    moving_.hold(increment, part_at(j, stages));
    if (storage_) moving_.for_each_row([&](int row) { warm(increment, row, next_warmer_); });
    if (!conducts_by_temperature()) return;
    const Columns& warmer = storage_ ? next_warmer_ : increment;
    moving_.for_each_row([&](int row) { conducted_.row(row) = linear_.conductivity[row] * warmer.row(row); });
  }

  // The same in fourth order.
  void advance_by_rates(int stages, double length, WatchedMean& mean) {
    for (int j = 2; j <= stages; ++j) {
      const Coefficients with = coefficients(j, stages);
      mean.advance(j, with, newer_, 0, static_cast<int>(newer_.rows()));
      rates(newer_, length, rates_);
      older_ = with.mu * newer_ + with.nu * older_ - with.product * rates_ + with.start * start_;
      older_.swap(newer_);
    }
  }

  [[nodiscard]] bool conducts_by_temperature() const { return !balance_.unit_flows().empty(); }

  using Pair = Eigen::Array2d;
  using ConstPair = Eigen::Map<const Pair>;
  static ConstPair pair(const Columns& columns, int row) {
    return ConstPair(columns.data() + 2 * static_cast<std::ptrdiff_t>(row));
  }

  const HeatModel& model_;
  Drives drives_;
  HeatBalance balance_;
  MovingDrive moving_;
  BentStorage storage_;
  Linearised linear_;                     // at the step's start
  Eigen::VectorXd inverse_;               // of its capacity, 0 for a fixed node [K/J]
  double stable_;                         // of eq. (8), there [s]
  std::optional<StableSteps> changing_;   // nothing if that is the same at all temperatures
  bool held_conductivity_bends_ = false;  // with a temperature that changes in time
  FlowNetwork sharing_;                   // B; empty in second order
  std::vector<NodeId> watched_;
  // Of the step: h C^-1 F at its start, and D of the last two stages.
  Columns start_, newer_, older_;
  Columns warmer_, next_warmer_;  // x of D of the last and of the next stage, where c depends on temperature
  // Where a stage takes more than a product with K: h L D in fourth order, what a second product gave, and k D.
  Columns rates_, beside_, conducted_;
};

}  // namespace

std::unique_ptr<TimeScheme> make_stabilised_scheme(const HeatModel& model, std::optional<StableSteps> stable) {
  SCREE_EXPECT(!model.shared_capacity || (has_constant_properties(model) && !varies_in_time(model)));
  return std::make_unique<StabilisedScheme>(model, stable ? *std::move(stable) : StableSteps(model));
}

}  // namespace scree::thermal
