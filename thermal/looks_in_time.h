// When two conditions are compared that must agree throughout a run.
#pragma once

#include <optional>

namespace scree::thermal {

// Temperatures that differ by less than this share of them are equal.
constexpr double equal_temperatures = 1e-9;

// Places with the same conditions tell the same: the first few of them are looked at closely, lest a pulse is missed, all
// others at three times only.
class LooksInTime {
 public:
  explicit LooksInTime(double until) : until_(until) {}

  // The first time, as far as looks tell, at which `differ(time)` holds [s].
  template <class Differ>
  std::optional<double> first(bool vary, const Differ& differ) {
    if (differ(0.0)) return 0.0;
    if (!vary) return std::nullopt;
    if (close_looks_ < most_close_looks) {
      ++close_looks_;
      for (int i = 1; i <= times; ++i) {
        if (const double time = until_ * i / times; differ(time)) return time;
      }
      return std::nullopt;
    }
    for (const double share : {0.37, 1.0}) {
      if (const double time = share * until_; differ(time)) return time;
    }
    return std::nullopt;
  }

 private:
  static constexpr int times = 1024;
  static constexpr int most_close_looks = 16;

  double until_;  // [s]
  int close_looks_ = 0;
};

}  // namespace scree::thermal
