#include "engine/mesh/surface_refinement.h"

#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace scree::mesh {

namespace {

using Edge = std::pair<std::size_t, std::size_t>;  // smaller node first

Edge edge_of(std::size_t a, std::size_t b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

class Refiner {
 public:
  Refiner(ClosedSurface surface, double longest) : surface_(std::move(surface)), longest_sq_(longest * longest) {
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) add(edge_of(surface_.triangles[t][i], surface_.triangles[t][(i + 1) % 3]), t);
    }
  }

  ClosedSurface run() {
    while (!long_edges_.empty()) {
      const Edge edge = long_edges_.rbegin()->second;
      long_edges_.erase(std::prev(long_edges_.end()));
      const std::set<std::size_t> beside = triangles_.extract(edge).mapped();
      const std::size_t middle = surface_.points.size();
      surface_.points.emplace_back((surface_.points[edge.first] + surface_.points[edge.second]) / 2);
      for (const std::size_t t : beside) split(t, edge, middle);
    }
    return std::move(surface_);
  }

 private:
  void add(const Edge& edge, std::size_t triangle) {
    triangles_[edge].insert(triangle);
    const double length_sq = (surface_.points[edge.first] - surface_.points[edge.second]).squaredNorm();
    if (length_sq > longest_sq_) long_edges_.insert({length_sq, edge});
  }

  // Triangle `t` keeps the first half of `edge`, a new triangle takes the second.
  void split(std::size_t t, const Edge& edge, std::size_t middle) {
    auto first = surface_.triangles[t], second = first;
    std::size_t opposite = 0;
    for (int i = 0; i < 3; ++i) {
      if (first[i] == edge.second) {
        first[i] = middle;
      } else if (second[i] == edge.first) {
        second[i] = middle;
      } else {
        opposite = first[i];
      }
    }
    const std::size_t made = surface_.triangles.size();
    surface_.triangles[t] = first;
    surface_.triangles.push_back(second);
    triangles_[edge_of(edge.second, opposite)].erase(t);
    add(edge_of(edge.second, opposite), made);
    add(edge_of(edge.first, middle), t);
    add(edge_of(edge.second, middle), made);
    add(edge_of(opposite, middle), t);
    add(edge_of(opposite, middle), made);
  }

  ClosedSurface surface_;
  double longest_sq_;
  std::map<Edge, std::set<std::size_t>> triangles_;
  std::set<std::pair<double, Edge>> long_edges_;
};

}  // namespace

ClosedSurface refined(ClosedSurface surface, double longest) {
  return Refiner(std::move(surface), longest).run();
}

}  // namespace scree::mesh
