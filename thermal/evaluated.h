// A value at places, worked out once where it is the same everywhere.
#pragma once

#include <optional>
#include <utility>

#include <Eigen/Core>

namespace scree::thermal {

// Value: double(const Eigen::Vector3d& place [m]).
template <class Value>
class Evaluated {
 public:
  Evaluated(bool varies_in_place, Value value) : varies_in_place_(varies_in_place), value_(std::move(value)) {}

  double operator()(const Eigen::Vector3d& place) {
    if (varies_in_place_) return value_(place);
    if (!everywhere_) everywhere_ = value_(place);
    return *everywhere_;
  }

 private:
  bool varies_in_place_;
  Value value_;
  std::optional<double> everywhere_;
};

}  // namespace scree::thermal
