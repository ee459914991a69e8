// What the ledger reads of a stabilised step: the mean of rkl2.h, at the few nodes that it asks for.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "thermal/moving_drive.h"
#include "thermal/rkl2.h"

namespace scree::thermal {

// S at the nodes that the ledger reads, which are ascending.
class WatchedMean {
 public:
  explicit WatchedMean(const std::vector<NodeId>& nodes) : nodes_(nodes) {
    for (std::vector<double>& mean : means_) mean.assign(nodes.size(), 0.0);
  }

  // Stage j of these rows, in the place of j - 2, from x of the one before.
  void advance(int j, const rkl2::Coefficients& with, const MovingDrive::Columns& increment, int first, int rows) {
    const std::vector<double>& newer = means_[(j - 1) % 2];
    std::vector<double>& older = means_[j % 2];
    const auto begin = std::lower_bound(nodes_.begin(), nodes_.end(), NodeId(static_cast<std::size_t>(first)));
    for (auto node = begin; node != nodes_.end() && node->value() < first + rows; ++node) {
      const auto i = static_cast<std::size_t>(node - nodes_.begin());
      older[i] = with.mu * newer[i] + with.nu * older[i] + with.product * increment(node->value(), 0);
    }
  }

  // The last of so many stages.
  [[nodiscard]] Eigen::VectorXd added_to(Eigen::VectorXd temperature, int stages) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) temperature[nodes_[i].value()] += means_[stages % 2][i];
    return temperature;
  }

 private:
  const std::vector<NodeId>& nodes_;
  std::array<std::vector<double>, 2> means_;
};

}  // namespace scree::thermal
