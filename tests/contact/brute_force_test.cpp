// The search against a plain one: every semi-spring with every face, every semi-edge with every edge, with a geometry of its
// own that knows blocks of a single simplex only and is written for clearness alone.
#include <map>
#include <optional>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

constexpr double facing = 0.17364817766693033;

// Projection on the flat through some corners, as barycentric weights; nothing if it lies outside them.
template <int dim>
std::optional<Eigen::VectorXd> projection(const std::vector<Point<dim>>& corners, const Point<dim>& point) {
  const auto count = static_cast<Eigen::Index>(corners.size());
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(count + 1, count + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Ones(count + 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) equations(i, j) = corners[i].dot(corners[j]);
    equations(i, count) = equations(count, i) = 1;
    right(i) = corners[i].dot(point);
  }
  equations(count, count) = 0;
  Eigen::VectorXd weights = equations.fullPivLu().solve(right).head(count);
  if (weights.minCoeff() < 0) return std::nullopt;
  return weights;
}

template <int dim>
struct Nearest {
  Point<dim> point;
  std::vector<int> corners;  // of the simplex, that span the place
  double distance = 1e300;
};

// Over all vertices, edges and the inside of the face opposite to a corner of the simplex.
template <int dim>
Nearest<dim> nearest_on_face(const Simplex<dim>& simplex, int opposite, const Point<dim>& point) {
  Nearest<dim> best;
  for (int mask = 1; mask < 1 << (dim + 1); ++mask) {
    if (mask & 1 << opposite) continue;
    std::vector<Point<dim>> corners;
    std::vector<int> which;
    for (int i = 0; i <= dim; ++i) {
      if (mask & 1 << i) corners.push_back(simplex[i]), which.push_back(i);
    }
    const auto weights = projection<dim>(corners, point);
    if (!weights) continue;
    Point<dim> at = Point<dim>::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) at += (*weights)[i] * corners[i];
    if ((at - point).norm() < best.distance) best = {at, which, (at - point).norm()};
  }
  return best;
}

// Unit normal of the face opposite to a corner: the gradient of that corner's barycentric coordinate, reversed.
template <int dim>
Point<dim> normal(const Simplex<dim>& simplex, int opposite) {
  Eigen::Matrix<double, dim + 1, dim + 1> rows;
  for (int i = 0; i <= dim; ++i) rows.row(i) << simplex[i].transpose(), 1;
  return -rows.inverse().col(opposite).template head<dim>().normalized();
}

template <int dim>
bool inside(const Simplex<dim>& simplex, const Point<dim>& point) {
  for (int i = 0; i <= dim; ++i) {
    if (normal<dim>(simplex, i).dot(point - simplex[(i + 1) % (dim + 1)]) > 0) return false;
  }
  return true;
}

template <int dim>
Point<dim> outwards(const Simplex<dim>& simplex, const std::vector<int>& corners) {
  Point<dim> sum = Point<dim>::Zero();
  for (int face = 0; face <= dim; ++face) {
    if (std::find(corners.begin(), corners.end(), face) != corners.end()) continue;
    double angle = 1;
    if (dim == 3 && corners.size() == 1) {
      std::vector<Point<dim>> ways;
      for (int i = 0; i <= dim; ++i) {
        if (i != face && i != corners[0]) ways.push_back((simplex[i] - simplex[corners[0]]).normalized());
      }
      angle = std::acos(ways[0].dot(ways[1]));
    }
    sum += angle * normal<dim>(simplex, face);
  }
  return sum;
}

template <int dim>
Point<dim> indented(const Simplex<dim>& simplex, int opposite, int corner, double indentation) {
  Point<dim> centre = Point<dim>::Zero();
  for (int i = 0; i <= dim; ++i) {
    if (i != opposite) centre += simplex[i] / dim;
  }
  return simplex[corner] + indentation * (centre - simplex[corner]);
}

template <int dim>
double mean_edge(const Simplex<dim>& simplex) {
  double sum = 0;
  for (int i = 0; i <= dim; ++i) {
    for (int j = 0; j < i; ++j) sum += (simplex[i] - simplex[j]).norm();
  }
  return sum / (dim * (dim + 1) / 2);
}

struct Found {
  std::size_t target = 0;
  double gap = 0;
};

// The target of the semi-spring of `corner` on the face opposite to `opposite` of simplex `own`.
template <int dim>
std::optional<Found> brute_force(const BlockOf<dim>& simplices, std::size_t own, int opposite, int corner,
                                 ContactOptions options) {
  const Simplex<dim>& owner = simplices[own];
  const Point<dim> point = indented<dim>(owner, opposite, corner, options.indentation);
  const double tolerance = options.tolerance * mean_edge<dim>(owner);
  std::optional<Found> best;
  for (std::size_t other = 0; other < simplices.size(); ++other) {
    for (int face = 0; face <= dim && other != own; ++face) {
      const Simplex<dim>& target = simplices[other];
      if (normal<dim>(target, face).dot(normal<dim>(owner, opposite)) >= 0) continue;
      const auto nearest = nearest_on_face<dim>(target, face, point);
      const double of_vertex = nearest_on_face<dim>(target, face, owner[corner]).distance;
      if (nearest.distance > tolerance && of_vertex > tolerance) continue;
      const double sign = outwards<dim>(target, nearest.corners).dot(point - nearest.point) < 0 ? -1 : 1;
      const Point<dim> direction = sign * (point - nearest.point).normalized();
      if (direction.dot(normal<dim>(owner, opposite)) > -facing) continue;
      if (sign < 0 && !inside<dim>(target, point)) continue;
      if (!best || nearest.distance < std::abs(best->gap)) best = {other, sign * nearest.distance};
    }
  }
  return best;
}

template <int dim>
void compare(std::size_t count, double box_size, const ContactOptions& options) {
  std::mt19937 random(11);
  BlockOf<dim> simplices = random_simplices<dim>(count, box_size, 0.5, random);
  // A tenth are twenty times smaller, so that the search has faces of several orders.
  for (std::size_t i = 0; i < simplices.size(); i += 10) {
    for (auto& corner : simplices[i]) corner = simplices[i][dim] + 0.05 * (corner - simplices[i][dim]);
  }
  const auto set = find_contacts<dim>(each_its_own<dim>(simplices), options);

  std::size_t hits = 0, springs = 0, next = 0;
  std::vector<Contact<dim>> points;
  for (const auto& contact : set.contacts) {
    if (contact.kind == Kind::point_face) points.push_back(contact);
  }
  for (std::size_t own = 0; own < simplices.size(); ++own) {
    std::vector<double> expected;
    std::multimap<double, std::size_t> targets;
    for (int opposite = 0; opposite <= dim; ++opposite) {
      for (int corner = 0; corner <= dim; ++corner) {
        if (corner == opposite) continue;
        ++springs;
        const auto found = brute_force<dim>(simplices, own, opposite, corner, options);
        if (found) expected.push_back(found->gap), targets.emplace(found->gap, found->target);
      }
    }
    std::vector<std::pair<double, std::size_t>> ours;
    for (; next < points.size() && points[next].owner == BlockId{own}; ++next) {
      ours.emplace_back(points[next].gap, points[next].target.index());
    }
    std::sort(ours.begin(), ours.end());
    hits += expected.size();
    ASSERT_EQ(ours.size(), expected.size()) << "of block " << own;
    std::size_t i = 0;
    for (const auto& [gap, target] : targets) {
      EXPECT_NEAR(ours[i].first, gap, 1e-9);
      EXPECT_EQ(ours[i].second, target);
      ++i;
    }
  }
  EXPECT_EQ(next, points.size());
  EXPECT_GT(hits, springs * 3 / 10) << "of " << springs << ": too few to be representative";
  EXPECT_LT(hits, springs * 7 / 10) << "of " << springs << ": too many to be representative";
}

TEST(FindContacts, OfTrianglesAreWhatBruteForceFinds) {
  compare<2>(150, 2.8, {0.05, 0.25});
}

TEST(FindContacts, OfTetrahedraAreWhatBruteForceFinds) {
  compare<3>(70, 0.9, {0.05, 0.2});
}

// Sine of how far the two faces at an edge rise above it along a direction, the larger of both.
double rise(const Simplex<3>& simplex, int a, int b, const Point<3>& direction) {
  const Point<3> along = (simplex[b] - simplex[a]).normalized();
  double highest = -1;
  for (int i = 0; i < 4; ++i) {
    if (i == a || i == b) continue;
    Point<3> inwards = simplex[i] - simplex[a];
    inwards -= inwards.dot(along) * along;
    highest = std::max(highest, inwards.normalized().dot(direction));
  }
  return highest;
}

// Of the two faces at an edge of a block the one that the mesh lists first, as the corner opposite to it. A mesh exchanges the
// first two corners of a simplex that is turned inside out.
int first_face(const Simplex<3>& simplex, std::array<int, 2> edge) {
  const bool turned = (simplex[1] - simplex[0]).cross(simplex[2] - simplex[0]).dot(simplex[3] - simplex[0]) < 0;
  for (int corner : {0, 1, 2, 3}) {
    if (turned && corner < 2) corner = 1 - corner;
    if (corner != edge[0] && corner != edge[1]) return corner;
  }
  return -1;
}

// How the semi-edge beside edge (a, b) of `owner`, on the face opposite to `opposite`, lies over edge (c, d) of `target`.
struct OverEdge {
  double gap;
  Point<3> from, from_edge, to;  // on the semi-edge, on the edge beside it, on the target
};

std::optional<OverEdge> over_edge(const Simplex<3>& owner, int opposite, std::array<int, 2> ab, const Simplex<3>& target,
                                  std::array<int, 2> cd, ContactOptions options) {
  const Point<3> start = indented<3>(owner, opposite, ab[0], options.indentation);
  const Point<3> end = indented<3>(owner, opposite, ab[1], options.indentation);
  const Point<3>&c = target[cd[0]], &d = target[cd[1]];
  Eigen::Matrix3d system;
  Point<3> direction = (end - start).cross(d - c);
  if (direction.norm() < 0.0175 * (end - start).norm() * (d - c).norm()) return std::nullopt;
  direction.normalize();
  if (direction.dot(outwards<3>(target, {cd[0], cd[1]})) < 0) direction = -direction;
  system << end - start, c - d, -direction;  // start + s (end - start) = c + t (d - c) + gap * direction
  const Point<3> solution = system.fullPivLu().solve(c - start);
  if (solution.head<2>().minCoeff() < 0 || solution.head<2>().maxCoeff() > 1) return std::nullopt;
  const double gap = solution[2], true_gap = (owner[ab[0]] - c).dot(direction);
  const double tolerance = options.tolerance * mean_edge<3>(owner);
  if (std::min(std::abs(gap), std::abs(true_gap)) > tolerance) return std::nullopt;
  if (direction.dot(normal<3>(owner, opposite)) > -facing) return std::nullopt;
  // The target edge comes within tolerance of the owner's face, and that face of the first face at the target edge.
  const auto away = [](const Simplex<3>& of, int face, const auto& points) {
    double low = 1e300, high = -1e300;
    for (const Point<3>& point : points) {
      const double height = normal<3>(of, face).dot(point - of[(face + 1) % 4]);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return std::max(low, -high);
  };
  std::vector<Point<3>> face;
  for (int i = 0; i < 4; ++i) {
    if (i != opposite) face.push_back(owner[i]);
  }
  const double reach = options.tolerance * std::max(mean_edge<3>(owner), mean_edge<3>(target));
  if (away(owner, opposite, std::vector<Point<3>>{c, d}) > tolerance) return std::nullopt;
  if (away(target, first_face(target, cd), face) > reach) return std::nullopt;
  if (rise(target, cd[0], cd[1], direction) > 0.0175 || rise(owner, ab[0], ab[1], -direction) > 0.0175) return std::nullopt;
  const double along = solution[0];
  return OverEdge{gap, start + along * (end - start), owner[ab[0]] + along * (owner[ab[1]] - owner[ab[0]]),
                  c + solution[1] * (d - c)};
}

// Where a line is in a simplex, as ways from its start; nothing if it passes it by (Cyrus and Beck).
std::optional<std::array<double, 2>> inside(const Simplex<3>& simplex, const Point<3>& start, const Point<3>& direction) {
  double first = -1e300, last = 1e300;
  for (int face = 0; face < 4; ++face) {
    const Point<3> out = normal<3>(simplex, face);
    const double slope = out.dot(direction), way = out.dot(simplex[(face + 1) % 4] - start) / slope;
    (slope < 0 ? first : last) = slope < 0 ? std::max(first, way) : std::min(last, way);
  }
  if (first > last) return std::nullopt;
  return std::array<double, 2>{first, last};
}

// Whether another block stands between the two, or they are behind each other without either being in the other.
bool is_hidden(const std::vector<Simplex<3>>& simplices, std::size_t own, std::size_t target, const OverEdge& over,
               double tolerance) {
  const double length = mean_edge<3>(simplices[own]), flat = 1e-4 * length;
  if (std::abs(over.gap) <= flat) return false;
  const Point<3> along = (over.to - over.from) / over.gap;
  const auto holds = [&](std::size_t block, const Point<3>& point) {
    const auto part = inside(simplices[block], point, along);
    return part && (*part)[0] <= 0 && (*part)[1] >= 0;
  };
  if (over.gap < 0 && !holds(target, over.from) && !holds(own, over.to)) return true;
  const auto another_before = [&](const Point<3>& from) {
    for (std::size_t third = 0; third < simplices.size(); ++third) {
      if (third == own || third == target) continue;
      const auto part = inside(simplices[third], from, along);
      if (!part || (*part)[0] >= along.dot(over.to - from) - flat || (*part)[0] < -2 * tolerance * length) continue;
      if ((*part)[0] >= -flat || (*part)[1] >= 0 || holds(own, from + (*part)[0] * along)) return true;
    }
    return false;
  };
  return another_before(over.from) && another_before(over.from_edge);
}

TEST(FindContacts, OfSemiEdgesAreWhatBruteForceFinds) {
  std::mt19937 random(5);
  const ContactOptions options{0.05, 0.1};
  const auto simplices = random_simplices<3>(70, 1.2, 0.5, random);
  const auto set = find_contacts<3>(each_its_own<3>(simplices), options);
  // Blocks that semi-springs join are left to them; brute force asks for each face at an edge, our set for the same.
  const auto joined = [&](std::size_t own, std::array<int, 2> edge, std::size_t other) {
    for (int face = 0; face < 4; ++face) {
      if (face == edge[0] || face == edge[1]) continue;
      for (int corner = 0; corner < 4; ++corner) {
        if (corner == face) continue;
        const auto found = brute_force<3>(simplices, own, face, corner, options);
        if (found && found->target == other) return true;
      }
    }
    return false;
  };
  std::multimap<std::size_t, double> expected, actual;
  int hidden = 0;
  for (std::size_t own = 0; own < simplices.size(); ++own) {
    for (int code = 0; code < 64; ++code) {
      const int opposite = code / 16, a = code / 4 % 4, b = code % 4;
      if (a >= b || a == opposite || b == opposite) continue;
      std::optional<OverEdge> best;
      std::size_t target = 0;
      for (std::size_t other = 0; other < simplices.size(); ++other) {
        for (int pair = 0; pair < 16 && other != own; ++pair) {
          const std::array<int, 2> cd{pair / 4, pair % 4};
          if (cd[0] >= cd[1]) continue;
          const auto over = over_edge(simplices[own], opposite, {a, b}, simplices[other], cd, options);
          if (!over || (best && std::abs(over->gap) >= std::abs(best->gap))) continue;
          if (joined(own, {a, b}, other) || joined(other, cd, own)) continue;
          best = over;
          target = other;
        }
      }
      if (!best) continue;
      if (is_hidden(simplices, own, target, *best, options.tolerance)) {
        ++hidden;
      } else {
        expected.emplace(own, best->gap);
      }
    }
  }
  for (const auto& contact : set.contacts) {
    if (contact.kind == Kind::edge_edge) actual.emplace(contact.owner.index(), contact.gap);
  }
  ASSERT_GT(expected.size(), 20);
  ASSERT_GT(hidden, 5);
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t own = 0; own < simplices.size(); ++own) {
    std::vector<double> ours, theirs;
    for (auto [at, last] = actual.equal_range(own); at != last; ++at) ours.push_back(at->second);
    for (auto [at, last] = expected.equal_range(own); at != last; ++at) theirs.push_back(at->second);
    std::sort(ours.begin(), ours.end());
    std::sort(theirs.begin(), theirs.end());
    ASSERT_EQ(ours.size(), theirs.size()) << "of block " << own;
    for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], theirs[i], 1e-9);
  }
}

}  // namespace
}  // namespace scree::contact
