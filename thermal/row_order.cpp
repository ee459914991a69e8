#include "thermal/row_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "thermal/row_bundles.h"

namespace scree::thermal {

namespace {

struct Place {
  std::int32_t slab, strip;
  double along;  // a strip [m]
  NodeId node;

  friend bool operator<(const Place& a, const Place& b) {
    return std::tie(a.slab, a.strip, a.along, a.node) < std::tie(b.slab, b.strip, b.along, b.node);
  }
};

// Slabs and strips of space.
class Grid {
 public:
  Grid(const Eigen::Matrix3Xd& places, std::size_t nodes) : least_(places.rowwise().minCoeff()) {
    const Eigen::Vector3d size = places.rowwise().maxCoeff() - least_;
    std::iota(axes_.begin(), axes_.end(), 0);
    std::sort(axes_.begin(), axes_.end(), [&](int a, int b) { return size[a] > size[b]; });
    const int dim = size[axes_[2]] > 0 ? 3 : 2;
    double filled = 1;
    for (int i = 0; i < dim; ++i) filled *= size[axes_[i]];
    thickness_ = std::pow(filled / static_cast<double>(nodes), 1.0 / dim);
  }

  [[nodiscard]] Place place(const Eigen::Vector3d& at, NodeId node) const {
    const auto layer = [&](int axis) { return static_cast<std::int32_t>((at[axis] - least_[axis]) / thickness_); };
    return {layer(axes_[0]), layer(axes_[1]), at[axes_[2]], node};
  }

 private:
  Eigen::Vector3d least_;
  std::array<int, 3> axes_;  // from the longest side to the shortest
  double thickness_;
};

}  // namespace

std::vector<NodeId> in_space_order(std::vector<NodeId> nodes, const Table<NodeId, BlockId>& blocks,
                                   const Eigen::Matrix3Xd& places) {
  const Grid grid(places, nodes.size());
  std::vector<Place> order;
  order.reserve(nodes.size());
  for (std::size_t first = 0; first < nodes.size();) {
    std::size_t end = first + 1;
    while (end < nodes.size() && blocks[nodes[end]] == blocks[nodes[first]]) ++end;
    const bool together = end - first <= rows_in_bundle;
    for (std::size_t i = first; i < end; ++i) {
      order.push_back(grid.place(places.col(nodes[together ? first : i].value()), nodes[i]));
    }
    first = end;
  }
  std::sort(order.begin(), order.end());
  std::transform(order.begin(), order.end(), nodes.begin(), [](const Place& place) { return place.node; });
  return nodes;
}

}  // namespace scree::thermal
