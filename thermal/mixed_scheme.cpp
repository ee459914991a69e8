// Short steps by one scheme, long ones by another. After a sudden start steps begin far shorter than what they end with, and
// stabilised explicit steps of few products cost less than the solves of implicit ones and a factorisation for each length.
//
// Both are of second order and carry the error T - V of a companion V of third order, so either goes on from the other's state.
// Which of them takes a step follows from its length alone: a run that goes on from an earlier state takes the same.
//
// The long steps are made ready on a thread of their own while the short ones go on.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "thermal/sdirk2.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

class MixedScheme : public TimeScheme {
 public:
  MixedScheme(std::unique_ptr<TimeScheme> of_short, MadeMeanwhile<LongSteps> of_long, double surely_short)
      : short_(std::move(of_short)), long_(std::move(of_long)), surely_short_(surely_short) {}

  Step step(const Instant& from, double length) override {
    return is_short(length) ? short_->step(from, length) : in_use().step(from, length);
  }

  double first_step(const Instant& from, double allowed) override {
    const double length = short_->first_step(from, allowed);
    return is_short(length) ? length : in_use().first_step(from, allowed);
  }

  [[nodiscard]] std::vector<Look> drive_quadrature(double length) const override {
    return (is_short(length) ? *short_ : *long_.get().scheme).drive_quadrature(length);
  }
  [[nodiscard]] int threads_beside(double length) const override { return is_short(length) && long_.under_way() ? 1 : 0; }
  [[nodiscard]] MatrixOrigin matrix_origin() const override { return in_use_ ? in_use_->matrix_origin() : MatrixOrigin(); }
  void take_matrix(const MatrixOrigin& origin) override {
    if (origin.temperature.size() > 0) in_use().take_matrix(origin);
  }
  [[nodiscard]] double safety() const override { return std::max(short_->safety(), sdirk2::safety); }
  [[nodiscard]] std::int64_t factorisations() const override { return in_use_ ? in_use_->factorisations() : 0; }
  [[nodiscard]] std::string name() const override {
    const double longest = std::max(surely_short_, long_.get().longest_short);
    if (std::isinf(longest)) return short_->name();
    return fmt::format("steps of up to {:.3g} s: {}; longer ones: {}", longest, short_->name(), long_.get().scheme->name());
  }

 private:
  [[nodiscard]] bool is_short(double length) const { return length <= surely_short_ || length <= long_.get().longest_short; }
  TimeScheme& in_use() {
    in_use_ = long_.get().scheme.get();
    return *in_use_;
  }

  std::unique_ptr<TimeScheme> short_;
  MadeMeanwhile<LongSteps> long_;
  double surely_short_;           // [s]
  TimeScheme* in_use_ = nullptr;  // that of the long ones, once it has done anything
};

}  // namespace

std::unique_ptr<TimeScheme> make_mixed_scheme(std::unique_ptr<TimeScheme> of_short, MadeMeanwhile<LongSteps> of_long,
                                              double surely_short) {
  return std::make_unique<MixedScheme>(std::move(of_short), std::move(of_long), surely_short);
}

}  // namespace scree::thermal
