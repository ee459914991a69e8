#include "thermal/detour.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace scree::thermal {

namespace {

// Nodes of a block by their places in it, and which have an edge in common.
template <int dim>
class Edges {
 public:
  Edges(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block)
      : mesh_(mesh), first_(block.nodes.first()), starts_(block.nodes.size() + 1, 0) {
    for_edges(block, [&](std::size_t from, std::size_t) { ++starts_[from + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    others_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for_edges(block, [&](std::size_t from, std::size_t to) { others_[next[from]++] = to; });
  }

  [[nodiscard]] const Point<dim>& at(std::size_t node) const { return mesh_.nodes[NodeId{first_ + node}]; }
  [[nodiscard]] std::size_t size() const { return starts_.size() - 1; }

  // Of all nodes from one of them along edges [m] (Dijkstra); infinite where none lead.
  [[nodiscard]] std::vector<double> ways_from(std::size_t start) const {
    std::vector<double> way(size(), std::numeric_limits<double>::infinity());
    using Reached = std::pair<double, std::size_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
    way[start] = 0;
    next.emplace(0, start);
    while (!next.empty()) {
      const auto [far, node] = next.top();
      next.pop();
      if (far > way[node]) continue;
      for (std::size_t k = starts_[node]; k < starts_[node + 1]; ++k) {
        const double through = far + (at(others_[k]) - at(node)).norm();
        if (through >= way[others_[k]]) continue;
        way[others_[k]] = through;
        next.emplace(through, others_[k]);
      }
    }
    return way;
  }

 private:
  template <class Visit>
  void for_edges(const mesh::Block& block, const Visit& visit) const {
    for (const ElementId element : block.elements) {
      for (const NodeId from : mesh_.elements[element]) {
        for (const NodeId to : mesh_.elements[element]) {
          if (from != to) visit(from.index() - first_, to.index() - first_);
        }
      }
    }
  }

  const mesh::BlockMesh<dim>& mesh_;
  std::size_t first_;
  std::vector<std::size_t> starts_, others_;
};

std::size_t furthest(const std::vector<double>& way) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (std::isfinite(way[i]) && way[i] > way[best]) best = i;
  }
  return best;
}

}  // namespace

template <int dim>
double detour(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block) {
  const Edges<dim> edges(mesh, block);
  const std::size_t end = furthest(edges.ways_from(0));
  const std::vector<double> ways = edges.ways_from(end);
  double straight = 0;
  for (std::size_t node = 0; node < edges.size(); ++node) {
    straight = std::max(straight, (edges.at(node) - edges.at(end)).norm());
  }
  return ways[furthest(ways)] / straight;
}

template double detour(const mesh::BlockMesh<2>&, const mesh::Block&);
template double detour(const mesh::BlockMesh<3>&, const mesh::Block&);

}  // namespace scree::thermal
