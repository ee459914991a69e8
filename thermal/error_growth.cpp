#include "thermal/error_growth.h"

#include <algorithm>
#include <cmath>

#include "engine/base/phases.h"
#include "thermal/heat_balance.h"
#include "thermal/least_value.h"

namespace scree::thermal {

namespace {

// Of a range. A dip of c that lies between two looks only makes steps longer than they should be, which `time_error` tells.
constexpr int looks = 256;
// No curve is looked at above it, however much heat a load brings [K].
constexpr double highest = 5000;

}  // namespace

ErrorGrowth::ErrorGrowth(const HeatModel& model) : model_(model) {
  if (!model.varying) return;
  const auto& curves = model.varying->specific_heat;
  varies_ = std::any_of(curves.begin(), curves.end(), [](const Curve& curve) { return !curve.constant(); });
  least_.resize(curves.size());
}

bool ErrorGrowth::include(const TemperatureRange& range) {
  if (!varies_ || (range.least >= range_.least && range.largest <= range_.largest)) return false;
  range_.include(range);
  for (std::size_t material = 0; material < least_.size(); ++material) {
    // Anew, so that a run that goes on from a state knows what an uninterrupted one does.
    least_[material] = least_value(model_.varying->specific_heat[material], range_, looks);
  }
  return true;
}

Eigen::VectorXd ErrorGrowth::at(const Eigen::VectorXd& temperature) const {
  if (!varies_) return {};
  const VaryingProperties& properties = *model_.varying;
  Eigen::VectorXd growth = capacity_at(model_, temperature);
  for_each_shortly(growth.size(), [&](Eigen::Index row) {
    const auto material = static_cast<std::size_t>(properties.material[NodeId(static_cast<std::size_t>(row))]);
    growth[row] = std::max(1.0, growth[row] / (properties.mass[row] * least_[material]));
  });
  return growth;
}

double ErrorGrowth::largest(const Eigen::VectorXd& error, const Eigen::VectorXd& growth) {
  return growth.size() == 0 ? error.lpNorm<Eigen::Infinity>() : error.cwiseProduct(growth).lpNorm<Eigen::Infinity>();
}

double ErrorGrowth::largest_rise(const Eigen::VectorXd& error, const Eigen::VectorXd& added, const Eigen::VectorXd& growth) {
  return largest((error.cwiseAbs() - (error - added).cwiseAbs()).cwiseMax(0), growth);
}

TemperatureRange given_until(Drives& drives, double until, const Eigen::VectorXd& temperature,
                             const Eigen::VectorXd& capacity) {
  // No multiples of each other, so that they meet every part of a swing.
  const int instants = drives.vary() ? 64 : 1;
  constexpr double golden = 0.6180339887498949;
  TemperatureRange range;
  double least = temperature.minCoeff(), largest = temperature.maxCoeff();
  for (int i = 0; i < instants; ++i) {
    const double turns = i * golden;
    const Drive& drive = drives.at(until * (turns - std::floor(turns)));
    range.include(drive);
    const Eigen::ArrayXd rates = drive.load.cwiseQuotient(capacity);  // [K/s]
    least += std::min(0.0, rates.minCoeff()) * until / instants;
    largest += std::max(0.0, rates.maxCoeff()) * until / instants;
  }
  range.include(TemperatureRange{std::max(least, 0.0), std::min(largest, highest)});
  return range;
}

}  // namespace scree::thermal
