#include "thermal/row_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

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

// Nodes that keep their order: those of a small block, or a single one.
struct Group {
  std::span<const NodeId> nodes;
  bool small_block;
};

std::vector<Group> groups_of(std::span<const NodeId> nodes, const Table<NodeId, BlockId>& blocks) {
  std::vector<Group> groups;
  for (std::size_t first = 0; first < nodes.size();) {
    std::size_t end = first + 1;
    while (end < nodes.size() && blocks[nodes[end]] == blocks[nodes[first]]) ++end;
    const bool small = end - first <= rows_in_bundle;
    const std::size_t size = small ? end - first : 1;
    for (; first < end; first += size) groups.push_back({nodes.subspan(first, size), small});
  }
  return groups;
}

std::vector<NodeId> by_slabs(const std::vector<Group>& groups, std::size_t nodes, const Eigen::Matrix3Xd& places) {
  const Grid grid(places, nodes);
  std::vector<Place> order;
  order.reserve(nodes);
  for (const Group& group : groups) {
    for (const NodeId node : group.nodes) order.push_back(grid.place(places.col(group.nodes[0].value()), node));
  }
  std::sort(order.begin(), order.end());
  std::vector<NodeId> ordered;
  ordered.reserve(nodes);
  for (const Place& place : order) ordered.push_back(place.node);
  return ordered;
}

bool is_before(const Group& a, const Group& b, const Eigen::Matrix3Xd& places, int axis) {
  const auto key = [&](const Group& group) { return std::pair(places(axis, group.nodes[0].value()), group.nodes[0]); };
  return key(a) < key(b);
}

int longest_side(std::span<const Group> groups, const Eigen::Matrix3Xd& places) {
  const auto at = [&](const Group& group) { return places.col(group.nodes[0].value()); };
  Eigen::Vector3d least = at(groups[0]), largest = least;
  for (const Group& group : groups) {
    least = least.cwiseMin(at(group));
    largest = largest.cwiseMax(at(group));
  }
  int axis = 0;
  (largest - least).maxCoeff(&axis);
  return axis;
}

// Halves them across their longest side, and each half again.
void halve(std::span<Group> groups, const Eigen::Matrix3Xd& places) {
  constexpr std::size_t few = 2;
  if (groups.size() <= few) return;
  const int axis = longest_side(groups, places);
  const std::size_t half = groups.size() / 2;
  std::nth_element(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(half), groups.end(),
                   [&](const Group& a, const Group& b) { return is_before(a, b, places, axis); });
  halve(groups.first(half), places);
  halve(groups.subspan(half), places);
}

// Those of a region: first nodes of larger blocks, as they are, then small blocks.
void order_region(std::span<Group> groups, const Eigen::Matrix3Xd& places) {
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return std::pair(a.small_block, a.nodes[0]) < std::pair(b.small_block, b.nodes[0]);
  });
  const auto small = std::find_if(groups.begin(), groups.end(), [](const Group& group) { return group.small_block; });
  halve({small, groups.end()}, places);
}

// Regions of as many rows each.
void order_regions(std::span<Group> groups, const Eigen::Matrix3Xd& places, int halvings) {
  if (halvings == 0 || groups.size() < 2) return order_region(groups, places);
  const int axis = longest_side(groups, places);
  std::sort(groups.begin(), groups.end(), [&](const Group& a, const Group& b) { return is_before(a, b, places, axis); });
  std::size_t rows = 0, half = 0, passed = 0;
  for (const Group& group : groups) rows += group.nodes.size();
  while (half < groups.size() && 2 * passed < rows) passed += groups[half++].nodes.size();
  order_regions(groups.first(half), places, halvings - 1);
  order_regions(groups.subspan(half), places, halvings - 1);
}

std::vector<NodeId> by_regions(std::vector<Group> groups, std::size_t nodes, const Eigen::Matrix3Xd& places) {
  constexpr int halvings = 2;  // two threads, and four, have regions of their own
  order_regions(groups, places, halvings);
  std::vector<NodeId> ordered;
  ordered.reserve(nodes);
  for (const Group& group : groups) ordered.insert(ordered.end(), group.nodes.begin(), group.nodes.end());
  return ordered;
}

}  // namespace

std::vector<NodeId> in_space_order(const std::vector<NodeId>& nodes, const Table<NodeId, BlockId>& blocks,
                                   const Eigen::Matrix3Xd& places) {
  std::vector<Group> groups = groups_of(nodes, blocks);
  return nodes.size() >= many_rows ? by_slabs(groups, nodes.size(), places)
                                   : by_regions(std::move(groups), nodes.size(), places);
}

}  // namespace scree::thermal
