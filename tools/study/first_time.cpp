#include "tools/study/first_time.h"

namespace scree::study {

std::optional<double> first_time_at(const std::vector<double>& times, const std::vector<double>& values, double value) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == value) return times[i];
    if (i == 0 || (values[i - 1] < value) == (values[i] < value)) continue;
    return times[i - 1] + (times[i] - times[i - 1]) * (value - values[i - 1]) / (values[i] - values[i - 1]);
  }
  return std::nullopt;
}

}  // namespace scree::study
