// Values at ascending places, linear in between and constant beyond the ends.
#pragma once

#include <vector>

namespace scree {

class LinearTable {
 public:
  // As many values as places, at least one; places strictly ascending.
  LinearTable(std::vector<double> places, std::vector<double> values);

  double operator()(double place) const;

  // At a place between two of the table's; of the interval above at one of these, and 0 beyond the ends.
  [[nodiscard]] double slope(double place) const;

  // From place 0, exact.
  [[nodiscard]] double integral(double place) const;

  // Places between the two, without them.
  [[nodiscard]] std::size_t places_between(double begin, double end) const;

  [[nodiscard]] double first() const { return places_.front(); }
  [[nodiscard]] double last() const { return places_.back(); }

 private:
  [[nodiscard]] std::size_t interval(double place) const;
  [[nodiscard]] double integral_from_first(double place) const;

  std::vector<double> places_;
  std::vector<double> values_;
  std::vector<double> sums_;  // integral from the first place to each
  double to_zero_ = 0;        // and to place 0
};

}  // namespace scree
