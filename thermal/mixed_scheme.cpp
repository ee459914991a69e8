// Short steps by one scheme, long ones by another. After a sudden start steps begin far shorter than what they end with, and
// stabilised explicit steps of few products cost less than the solves of implicit ones and a factorisation for each length.
//
// Both are of second order and carry the error T - V of a companion V of third order, so either goes on from the other's state.
// Which of them takes a step follows from its length alone: a run that goes on from an earlier state takes the same.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

class MixedScheme : public TimeScheme {
 public:
  MixedScheme(std::unique_ptr<TimeScheme> of_short, std::unique_ptr<TimeScheme> of_long, double longest_short)
      : short_(std::move(of_short)), long_(std::move(of_long)), longest_short_(longest_short) {}

  Step step(const Instant& from, double length) override { return of(length).step(from, length); }

  double first_step(const Instant& from, double allowed) override {
    const double length = short_->first_step(from, allowed);
    return length <= longest_short_ ? length : long_->first_step(from, allowed);
  }

  [[nodiscard]] std::vector<Look> drive_quadrature(double length) const override { return of(length).drive_quadrature(length); }
  [[nodiscard]] MatrixOrigin matrix_origin() const override { return long_->matrix_origin(); }
  void take_matrix(const MatrixOrigin& origin) override { long_->take_matrix(origin); }
  [[nodiscard]] double safety() const override { return std::max(short_->safety(), long_->safety()); }
  [[nodiscard]] std::int64_t factorisations() const override { return long_->factorisations(); }
  [[nodiscard]] Sums sums() const override { return long_->sums(); }
  [[nodiscard]] double cost_exponent() const override { return long_->cost_exponent(); }
  [[nodiscard]] ChosenSolver solver() const override { return long_->solver(); }
  [[nodiscard]] std::string name() const override {
    return fmt::format("steps of up to {:.3g} s: {}; longer ones: {}", longest_short_, short_->name(), long_->name());
  }

 private:
  [[nodiscard]] TimeScheme& of(double length) const { return length <= longest_short_ ? *short_ : *long_; }

  std::unique_ptr<TimeScheme> short_;
  std::unique_ptr<TimeScheme> long_;
  double longest_short_;  // [s]
};

}  // namespace

std::unique_ptr<TimeScheme> make_mixed_scheme(std::unique_ptr<TimeScheme> of_short, std::unique_ptr<TimeScheme> of_long,
                                              double longest_short) {
  return std::make_unique<MixedScheme>(std::move(of_short), std::move(of_long), longest_short);
}

}  // namespace scree::thermal
