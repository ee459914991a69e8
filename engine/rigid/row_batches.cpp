#include "engine/rigid/row_batches.h"

#include <algorithm>
#include <cstdlib>

namespace scree::rigid {

namespace {

// Enough to place the cuts between slabs.
constexpr std::size_t samples = 1024;

int longest_axis(const std::vector<Eigen::Vector3d>& centres) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& centre : centres) mean += centre;
  mean /= static_cast<double>(centres.size());
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();
  for (const auto& centre : centres) spread += (centre - mean).cwiseAbs2();
  int axis = 0;
  spread.maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<int> slabs_of(const std::vector<Eigen::Vector3d>& centres, int slabs) {
  std::vector<int> result(centres.size(), 0);
  if (centres.empty() || slabs < 2) return result;
  const int axis = longest_axis(centres);
  std::vector<double> along;
  for (std::size_t i = 0; i < centres.size(); i += 1 + centres.size() / samples) along.push_back(centres[i][axis]);
  std::sort(along.begin(), along.end());
  std::vector<double> cuts;
  for (int i = 1; i < slabs; ++i) cuts.push_back(along[along.size() * i / slabs]);
  std::transform(centres.begin(), centres.end(), result.begin(), [&](const Eigen::Vector3d& centre) {
    return static_cast<int>(std::upper_bound(cuts.begin(), cuts.end(), centre[axis]) - cuts.begin());
  });
  return result;
}

int batch_of(int first_slab, int second_slab, int slabs) {
  if (first_slab < 0) return second_slab;
  if (second_slab < 0) return first_slab;
  return std::abs(first_slab - second_slab) > 1 ? slabs : std::min(first_slab, second_slab);
}

}  // namespace scree::rigid
