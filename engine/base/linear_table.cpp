#include "engine/base/linear_table.h"

#include <algorithm>

#include "engine/base/between.h"
#include "engine/base/check.h"

namespace scree {

LinearTable::LinearTable(std::vector<double> places, std::vector<double> values)
    : places_(std::move(places)), values_(std::move(values)), sums_{0} {
  SCREE_EXPECT(!places_.empty() && places_.size() == values_.size());
  SCREE_EXPECT(std::adjacent_find(places_.begin(), places_.end(), std::greater_equal<>()) == places_.end());
  for (std::size_t i = 1; i < places_.size(); ++i) {
    sums_.push_back(sums_.back() + 0.5 * (values_[i] + values_[i - 1]) * (places_[i] - places_[i - 1]));
  }
  to_zero_ = integral_from_first(0);
}

// The interval that begins at the last place that is not above; `place` is between the ends.
std::size_t LinearTable::interval(double place) const {
  const auto above = std::upper_bound(places_.begin(), places_.end(), place);
  const auto index = static_cast<std::size_t>(above - places_.begin());
  return std::min(index - 1, places_.size() - 2);
}

double LinearTable::operator()(double place) const {
  if (place <= first()) return values_.front();
  if (place >= last()) return values_.back();
  const std::size_t i = interval(place);
  const double share = (place - places_[i]) / (places_[i + 1] - places_[i]);
  return values_[i] + share * (values_[i + 1] - values_[i]);
}

double LinearTable::slope(double place) const {
  if (place < first() || place >= last()) return 0;
  const std::size_t i = interval(place);
  return (values_[i + 1] - values_[i]) / (places_[i + 1] - places_[i]);
}

double LinearTable::integral_from_first(double place) const {
  if (place <= first()) return (place - first()) * values_.front();
  if (place >= last()) return sums_.back() + (place - last()) * values_.back();
  const std::size_t i = interval(place);
  return sums_[i] + 0.5 * (values_[i] + (*this)(place)) * (place - places_[i]);
}

double LinearTable::integral(double place) const {
  return integral_from_first(place) - to_zero_;
}

std::size_t LinearTable::places_between(double begin, double end) const {
  return count_between(places_, begin, end);
}

}  // namespace scree
