#include "contact/edge_bounds.h"

#include <algorithm>
#include <cmath>

#include "contact/touch.h"

namespace scree::contact {

namespace {

using Direction = std::array<float, 3>;

float dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction cross(const Direction& a, const Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Direction minus(const Direction& a, const Direction& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Direction lane(const LanePoints<3>& points, int i) {
  return {points[0][i], points[1][i], points[2][i]};
}

}  // namespace

bool may_face(const Shell<3>& owner, const ElementEdge& edge, int beside, const Shell<3>& other, const ElementEdge& target) {
  const auto way = [](const Shell<3>& shell, int from, int to) { return minus(lane(shell.at, to), lane(shell.at, from)); };
  Direction normal = cross(way(owner, edge.start, edge.end), way(other, target.start, target.end));
  const float length = std::sqrt(dot(normal, normal));
  constexpr float unsure = 1e-3F;
  const float outwards =
      dot(normal, lane(other.normals, target.beside[0])) + dot(normal, lane(other.normals, target.beside[1]));
  if (std::abs(outwards) < unsure * length) return true;
  if (outwards < 0) normal = {-normal[0], -normal[1], -normal[2]};
  if (dot(normal, lane(owner.normals, beside)) > (unsure - static_cast<float>(least_facing)) * length) return false;
  for (int i = 0; i < 2; ++i) {
    if (dot(normal, way(owner, edge.start, edge.beside[i])) < -flat_sine_bound * length * 2 * owner.radius) return false;
    if (dot(normal, way(other, target.start, target.beside[i])) > flat_sine_bound * length * 2 * other.radius) return false;
  }
  return true;
}

}  // namespace scree::contact
