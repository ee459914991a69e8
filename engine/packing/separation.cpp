#include "engine/packing/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/quad.h"

namespace scree::packing {

namespace {

using Eigen::Vector3d;
using Feature = Separation::Feature;

constexpr std::size_t four = numbers_in_quad;
constexpr std::size_t numbers_of_four = 4 * four;  // in PlacedPiece::by_fours

std::size_t fours(std::size_t count) {
  return (count + four - 1) / four;
}

// Of a face, in PlacedPiece::by_fours.
std::size_t place_of(std::size_t face) {
  return face / four * numbers_of_four + face % four;
}

double face_distance(const PlacedPiece& owner, std::int32_t face, const PlacedPiece& other) {
  const double* numbers = &owner.by_fours[place_of(static_cast<std::size_t>(face))];
  const Vector3d normal(numbers[0], numbers[four], numbers[2 * four]);
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& vertex : other.vertices) least = std::min(least, normal.dot(vertex));
  return least - numbers[3 * four];
}

struct Quads {
  Quad x, y, z, distance;
};

SCREE_INLINE Quads faces_from(const PlacedPiece& piece, std::size_t first) {
  const double* numbers = &piece.by_fours[place_of(first)];
  Quads faces;
  load(faces.x, numbers);
  load(faces.y, numbers + four);
  load(faces.z, numbers + 2 * four);
  load(faces.distance, numbers + 3 * four);
  return faces;
}

SCREE_INLINE Quad along(const Quads& faces, const Vector3d& way) {
  return faces.x * way.x() + faces.y * way.y() + faces.z * way.z();
}

// How far the other piece is from each face; one number for each, and some more to fill the last four.
SCREE_WIDE void find_face_distances(const PlacedPiece& owner, const PlacedPiece& other, double* distances) {
  for (std::size_t f = 0; f < owner.normals.size(); f += four) {
    const Quads faces = faces_from(owner, f);
    Quad least = along(faces, other.vertices[0]);
    for (std::size_t i = 1; i < other.vertices.size(); ++i) {
      const Quad here = along(faces, other.vertices[i]);
      least = here < least ? here : least;
    }
    store(least - faces.distance, distances + f);
  }
}

// Of the faces of one piece along the edges of the other, fours of faces for each edge [m].
SCREE_WIDE void find_along_edges(const PlacedPiece& with_faces, const PlacedPiece& with_edges, double* found) {
  for (const auto& edge : with_edges.piece->edges) {
    const Vector3d direction = with_edges.vertices[edge.corners[1]] - with_edges.vertices[edge.corners[0]];
    for (std::size_t f = 0; f < with_faces.normals.size(); f += four) {
      store(along(faces_from(with_faces, f), direction), found);
      found += four;
    }
  }
}

// Memory of each thread for what is worked out four at a time.
struct Scratch {
  std::vector<double> distances, first_along_second, second_along_first;
};

Scratch& scratch() {
  static thread_local Scratch memory;
  return memory;
}

// Returns true if the pieces are more than `enough` apart.
template <class Allowed>
bool best_face(const PlacedPiece& owner, const PlacedPiece& other, Feature feature, double enough, const Allowed& allowed,
               Separation& best) {
  std::vector<double>& distances = scratch().distances;
  distances.resize(fours(owner.normals.size()) * four);
  find_face_distances(owner, other, distances.data());
  for (std::size_t f = 0; f < owner.normals.size(); ++f) {
    const double distance = distances[f];
    if (distance <= best.distance) continue;
    const auto face = static_cast<std::int32_t>(f);
    const Vector3d normal = feature == Feature::face_of_first ? owner.normals[f] : Vector3d(-owner.normals[f]);
    const Separation found{distance, normal, feature, face, face};
    if (!allowed(found)) continue;
    best = found;
    if (distance > enough) return true;
  }
  return false;
}

struct EdgeArc {
  Vector3d from;         // a point of the edge
  Vector3d direction;    // along it, not unit
  const Vector3d& left;  // normals of its two faces
  const Vector3d& right;
};

EdgeArc arc(const PlacedPiece& placed, std::size_t edge) {
  const auto& e = placed.piece->edges[edge];
  const Vector3d& from = placed.vertices[e.corners[0]];
  return {from, placed.vertices[e.corners[1]] - from, placed.normals[e.faces[0]], placed.normals[e.faces[1]]};
}

// Do the arcs left-right of an edge and -left to -right of another one cross on the unit sphere? By the faces beside each
// along the other one, whose direction is left x right times a positive number. Without a branch for each question.
bool arcs_cross(double first_left, double first_right, double second_left, double second_right) {
  const bool second_apart = second_left * second_right < 0, first_apart = first_left * first_right < 0;
  const bool facing = second_left * first_right < 0;
  return (static_cast<int>(second_apart) & static_cast<int>(first_apart) & static_cast<int>(facing)) != 0;
}

bool arcs_cross(const EdgeArc& a, const EdgeArc& b) {
  return arcs_cross(a.left.dot(b.direction), a.right.dot(b.direction), b.left.dot(a.direction), b.right.dot(a.direction));
}

// From the edge of the first towards that of the second, along their common perpendicular that points out of the first, which
// has the length of the edges' cross product.
struct EdgeAxis {
  EdgeAxis(const EdgeArc& a, const EdgeArc& b) : along(a.direction.cross(b.direction)), length_sq(along.squaredNorm()) {
    // A direction is off by as much as its ends are rounded, which counts far from the origin.
    const double a_sq = a.direction.squaredNorm(), b_sq = b.direction.squaredNorm();
    const double rounded = 4 * std::numeric_limits<double>::epsilon() * a.from.lpNorm<Eigen::Infinity>();
    parallel = length_sq < std::max(1e-16 * a_sq * b_sq, rounded * rounded * (a_sq + b_sq));
    outwards = a.left + a.right;
    way = b.from - a.from;
  }

  // Whether the distance is below another one by more than it may be off by rounding, found without a root.
  [[nodiscard]] bool below(double other) const {
    constexpr double rounding = 1e-12;
    const double bound = other - rounding * way.lpNorm<1>();
    const double reach = along.dot(outwards) < 0 ? -along.dot(way) : along.dot(way);
    const double reach_sq = reach * reach, bound_sq = bound * bound * length_sq;
    if (bound < 0) return reach < 0 && reach_sq > bound_sq * (1 + rounding);
    return reach < 0 || reach_sq < bound_sq * (1 - rounding);
  }

  [[nodiscard]] Vector3d normal() const {
    const Vector3d unit = along / std::sqrt(length_sq);
    return unit.dot(outwards) < 0 ? Vector3d(-unit) : unit;
  }

  Vector3d along, outwards, way;
  double length_sq;
  bool parallel;
};

template <class Allowed>
void best_edges(const PlacedPiece& first, const PlacedPiece& second, double enough, double face_bias, const Allowed& allowed,
                Separation& best) {
  const auto &first_edges = first.piece->edges, &second_edges = second.piece->edges;
  const std::size_t first_stride = fours(first.normals.size()) * four, second_stride = fours(second.normals.size()) * four;
  auto& [distances, first_along_second, second_along_first] = scratch();
  first_along_second.resize(second_edges.size() * first_stride);
  second_along_first.resize(first_edges.size() * second_stride);
  find_along_edges(first, second, first_along_second.data());
  find_along_edges(second, first, second_along_first.data());
  double to_beat = best.distance + face_bias;
  for (std::size_t i = 0; i < first_edges.size(); ++i) {
    const auto [left, right] = first_edges[i].faces;
    const double* of_second = &second_along_first[i * second_stride];
    for (std::size_t j = 0; j < second_edges.size(); ++j) {
      const double* of_first = &first_along_second[j * first_stride];
      const auto& beside = second_edges[j].faces;
      if (!arcs_cross(of_first[left], of_first[right], of_second[beside[0]], of_second[beside[1]])) continue;
      const EdgeAxis axis(arc(first, i), arc(second, j));
      if (axis.parallel || axis.below(to_beat)) continue;
      const Vector3d normal = axis.normal();
      const double distance = normal.dot(axis.way);
      if (distance <= to_beat) continue;
      const Separation found{distance, normal, Feature::edges, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
      if (!allowed(found)) continue;
      to_beat = distance;
      best = found;
      if (distance > enough) return;
    }
  }
}

template <class Allowed>
Separation best_separation(const PlacedPiece& first, const PlacedPiece& second, double enough, double face_bias,
                           const Allowed& allowed) {
  Separation best;
  best.distance = -std::numeric_limits<double>::infinity();
  if (best_face(first, second, Feature::face_of_first, enough, allowed, best)) return best;
  if (best_face(second, first, Feature::face_of_second, enough, allowed, best)) return best;
  best_edges(first, second, enough, face_bias, allowed, best);
  return best;
}

}  // namespace

PlacedPiece placed(const mesh::ConvexPiece& piece, const Pose& pose) {
  PlacedPiece result;
  place(piece, pose.rotation.toRotationMatrix(), pose.translation, result);
  return result;
}

void place(const mesh::ConvexPiece& piece, const Eigen::Matrix3d& rotation, const Vector3d& translation, PlacedPiece& result) {
  result.piece = &piece;
  result.vertices.clear();
  result.normals.clear();
  result.by_fours.assign(fours(piece.faces.size()) * numbers_of_four, 0.0);
  for (const Vector3d& vertex : piece.vertices) result.vertices.emplace_back(rotation * vertex + translation);
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const Vector3d& normal = result.normals.emplace_back(rotation * piece.faces[f].normal);
    double* numbers = &result.by_fours[place_of(f)];
    for (std::size_t axis = 0; axis < 3; ++axis) numbers[axis * four] = normal[static_cast<Eigen::Index>(axis)];
    numbers[3 * four] = normal.dot(result.vertices[piece.faces[f].corners[0]]);
  }
}

PlacedPiece shifted(PlacedPiece piece, const Vector3d& by) {
  for (Vector3d& vertex : piece.vertices) vertex += by;
  for (std::size_t f = 0; f < piece.normals.size(); ++f) piece.by_fours[place_of(f) + 3 * four] += piece.normals[f].dot(by);
  return piece;
}

Separation separation(const PlacedPiece& first, const PlacedPiece& second, double enough, double face_bias) {
  return best_separation(first, second, enough, face_bias, [](const Separation&) { return true; });
}

Separation separation_by(const PlacedPiece& first, const PlacedPiece& second, double face_bias,
                         const std::function<bool(const Separation&)>& allowed) {
  return best_separation(first, second, std::numeric_limits<double>::infinity(), face_bias, allowed);
}

double separation_along(const PlacedPiece& first, const PlacedPiece& second, const Separation& earlier) {
  if (earlier.feature == Feature::face_of_first) return face_distance(first, earlier.of_first, second);
  if (earlier.feature == Feature::face_of_second) return face_distance(second, earlier.of_second, first);
  const EdgeArc a = arc(first, earlier.of_first);
  const EdgeArc b = arc(second, earlier.of_second);
  if (!arcs_cross(a, b)) return -std::numeric_limits<double>::infinity();
  const EdgeAxis axis(a, b);
  return axis.parallel ? -std::numeric_limits<double>::infinity() : axis.normal().dot(axis.way);
}

}  // namespace scree::packing
