#include "thermal/detour.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "engine/base/grouped.h"

namespace scree::thermal {

namespace {

// Nodes of a block by their places in it.
template <int dim>
class Edges {
 public:
  Edges(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block) : mesh_(mesh), nodes_(block.nodes) {
    others_ = grouped<std::size_t>(1, nodes_.size(), [&](std::size_t, const auto& visit) {
      for (const ElementId element : block.elements) {
        for (const NodeId from : mesh.elements[element]) {
          for (const NodeId to : mesh.elements[element]) {
            if (from != to) visit(static_cast<std::uint32_t>(from.index() - nodes_.first()), to.index() - nodes_.first());
          }
        }
      }
    });
  }

  [[nodiscard]] const Point<dim>& at(std::size_t node) const { return mesh_.nodes[NodeId{nodes_.first() + node}]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

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
      for (const std::size_t other : others_.of(node)) {
        const double through = far + (at(other) - at(node)).norm();
        if (through >= way[other]) continue;
        way[other] = through;
        next.emplace(through, other);
      }
    }
    return way;
  }

 private:
  const mesh::BlockMesh<dim>& mesh_;
  IdRange<NodeId> nodes_;
  Grouped<std::size_t, std::size_t> others_;  // which have an edge in common with each
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
