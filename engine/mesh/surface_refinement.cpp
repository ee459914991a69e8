#include "engine/mesh/surface_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

namespace scree::mesh {

namespace {

using Edge = std::pair<std::size_t, std::size_t>;  // smaller node first

Edge edge_of(std::size_t a, std::size_t b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

// Of the longer diagonal: a quadrilateral that is bent by less is flat, and its diagonal may be changed. Files hold coordinates
// in single precision.
constexpr double flat = 1e-6;

// The other diagonal must be better by this much, so that rounding never turns one back.
constexpr double better = 1e-3;

// A thickness that is rounding.
constexpr double no_area = 1e-10;

// Twice the area over the square of the longest edge.
double thickness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d u = b - a, v = c - a;
  return u.cross(v).norm() / std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
}

double cotangent(const Eigen::Vector3d& at, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - at).dot(b - at) / (a - at).cross(b - at).norm();
}

// Whether the triangles a, b, c and b, a, d are better cut from c to d: in one plane, and against Delaunay's rule, by which
// the angles at c and d make less than half a turn.
bool wants_other_diagonal(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                          const Eigen::Vector3d& d) {
  if (cotangent(c, a, b) + cotangent(d, a, b) > -better) return false;
  const Eigen::Vector3d across = (b - a).cross(d - c);
  const double longest = std::max((b - a).norm(), (d - c).norm());
  if (std::abs(across.dot(c - a)) > flat * longest * across.norm()) return false;
  const auto side = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& point) {
    return (to - from).cross(point - from).dot(across);
  };
  const bool along_edge = thickness(a, b, c) <= flat || thickness(a, b, d) <= flat;
  const bool parted = along_edge || side(a, b, c) * side(a, b, d) < 0;
  return parted && side(c, d, a) * side(c, d, b) < 0;
}

class Refiner {
 public:
  Refiner(ClosedSurface surface, double longest) : surface_(std::move(surface)), longest_sq_(longest * longest) {
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) add(edge_of(surface_.triangles[t][i], surface_.triangles[t][(i + 1) % 3]), t);
    }
  }

  ClosedSurface run() {
    for (const auto& [edge, beside] : triangles_) doubtful_.push_back(edge);
    improve();
    while (!long_edges_.empty()) {
      const Edge edge = long_edges_.rbegin()->second;
      long_edges_.erase(std::prev(long_edges_.end()));
      const std::set<std::size_t> beside = triangles_.extract(edge).mapped();
      const std::size_t middle = surface_.points.size();
      surface_.points.emplace_back((surface_.points[edge.first] + surface_.points[edge.second]) / 2);
      for (const std::size_t t : beside) split(t, edge, middle);
      improve();
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
    for (const std::size_t end : {edge.first, edge.second}) {
      doubtful_.push_back(edge_of(end, middle));
      doubtful_.push_back(edge_of(end, opposite));
    }
    doubtful_.push_back(edge_of(opposite, middle));
  }

  // Turns diagonals in flat parts until all of those that are in doubt keep Delaunay's rule (Lawson 1977).
  void improve() {
    while (!doubtful_.empty()) {
      const Edge edge = doubtful_.back();
      doubtful_.pop_back();
      const auto found = triangles_.find(edge);
      if (found == triangles_.end() || found->second.size() != 2) continue;
      const std::size_t s = *found->second.begin(), t = *found->second.rbegin();
      const std::size_t c = opposite_of(s, edge), d = opposite_of(t, edge);
      const auto& points = surface_.points;
      if (c == d || triangles_.contains(edge_of(c, d))) continue;
      if (wants_other_diagonal(points[edge.first], points[edge.second], points[c], points[d])) turn(edge, {s, t}, {c, d});
    }
  }

  [[nodiscard]] std::size_t opposite_of(std::size_t t, const Edge& edge) const {
    const auto& nodes = surface_.triangles[t];
    return *std::find_if(nodes.begin(), nodes.end(), [&](std::size_t n) { return n != edge.first && n != edge.second; });
  }

  // `edge` of two triangles is replaced by the one between their opposite corners.
  void turn(const Edge& edge, std::array<std::size_t, 2> beside, std::array<std::size_t, 2> opposite) {
    const auto [a, b] = edge;
    const auto [s, t] = beside;
    const auto [c, d] = opposite;
    const auto replace = [&](std::size_t triangle, std::size_t corner, std::size_t by) {
      auto& nodes = surface_.triangles[triangle];
      *std::find(nodes.begin(), nodes.end(), corner) = by;
    };
    replace(s, b, d);
    replace(t, a, c);
    triangles_.erase(edge);
    long_edges_.erase({(surface_.points[a] - surface_.points[b]).squaredNorm(), edge});
    triangles_[edge_of(a, d)].erase(t);
    triangles_[edge_of(b, c)].erase(s);
    add(edge_of(a, d), s);
    add(edge_of(b, c), t);
    add(edge_of(c, d), s);
    add(edge_of(c, d), t);
    for (const Edge& around : {edge_of(a, c), edge_of(a, d), edge_of(b, c), edge_of(b, d)}) doubtful_.push_back(around);
  }

  ClosedSurface surface_;
  double longest_sq_;
  std::map<Edge, std::set<std::size_t>> triangles_;
  std::set<std::pair<double, Edge>> long_edges_;
  std::vector<Edge> doubtful_;
};

}  // namespace

bool is_flat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return thickness(a, b, c) <= no_area;
}

ClosedSurface refined(ClosedSurface surface, double longest) {
  return Refiner(std::move(surface), longest).run();
}

}  // namespace scree::mesh
