#include "engine/mesh/arrangement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/mesh/problems.h"
#include "engine/mesh/random_numbers.h"

namespace scree::mesh {

namespace {

// Failures in a row after which a region counts as full.
constexpr int most_attempts = 100000;

std::vector<Pose> lattice(const OnLattice& asked, int dimension) {
  const int layers = dimension == 2 ? 1 : asked.count[2];
  const Eigen::Vector3d middle((asked.count[0] - 1) / 2.0, (asked.count[1] - 1) / 2.0, (layers - 1) / 2.0);
  std::vector<Pose> poses;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < asked.count[1]; ++j) {
      for (int i = 0; i < asked.count[0]; ++i) {
        const Eigen::Vector3d offset = (Eigen::Vector3d(i, j, k) - middle).cwiseProduct(asked.spacing);
        poses.push_back({asked.centre + offset, asked.rotation});
      }
    }
  }
  return poses;
}

// Centres in cells of space about one diameter wide, so that only neighbours need to be asked.
class CentreGrid {
 public:
  CentreGrid(const Eigen::AlignedBox3d& region, double diameter) : low_(region.min()), distance_(diameter) {
    constexpr double most_cells = 200;  // per axis
    for (int axis = 0; axis < 3; ++axis) {
      const double length = region.sizes()[axis];
      count_[axis] = static_cast<int>(std::clamp(std::floor(length / diameter), 1.0, most_cells));
      width_[axis] = length > 0 ? length / count_[axis] : 1.0;
    }
    cells_.resize(static_cast<std::size_t>(count_.prod()));
  }

  [[nodiscard]] bool is_free(const Eigen::Vector3d& centre) const {
    const Eigen::Array3i at = cell(centre);
    const Eigen::Array3i low = (at - 1).max(0), high = (at + 1).min(count_ - 1);
    for (int k = low.z(); k <= high.z(); ++k) {
      for (int j = low.y(); j <= high.y(); ++j) {
        for (int i = low.x(); i <= high.x(); ++i) {
          for (const Eigen::Vector3d& other : cells_[index({i, j, k})]) {
            if ((other - centre).squaredNorm() < distance_ * distance_) return false;
          }
        }
      }
    }
    return true;
  }

  void add(const Eigen::Vector3d& centre) { cells_[index(cell(centre))].push_back(centre); }

 private:
  [[nodiscard]] Eigen::Array3i cell(const Eigen::Vector3d& p) const {
    return ((p - low_).array() / width_).floor().cast<int>().max(0).min(count_ - 1);
  }
  [[nodiscard]] std::size_t index(const Eigen::Array3i& c) const {
    const Eigen::Array<std::size_t, 3, 1> at = c.cast<std::size_t>(), count = count_.cast<std::size_t>();
    return (at.z() * count.y() + at.y()) * count.x() + at.x();
  }

  Eigen::Vector3d low_;
  double distance_;
  Eigen::Array3i count_;
  Eigen::Array3d width_;
  std::vector<std::vector<Eigen::Vector3d>> cells_;
};

InputError does_not_fit(const BodySpec& body, const AtRandom& asked, double radius, std::size_t fitted) {
  return body_error(
      body, "random.count", fmt::format("{}", asked.count),
      fmt::format("{} fitted into the region without touching, each in a sphere of radius {:.6g} m", fitted, radius),
      "Ask for fewer, enlarge low and high, or use a lattice");
}

std::vector<Pose> at_random(const BodySpec& body, const AtRandom& asked, const Bounds& bounds, int dimension) {
  Eigen::Vector3d margin = Eigen::Vector3d::Constant(bounds.radius);
  Eigen::AlignedBox3d centres(asked.low + margin, asked.high - margin);
  if (dimension == 2) centres.min().z() = centres.max().z() = 0;
  if (centres.isEmpty()) throw does_not_fit(body, asked, bounds.radius, 0);
  CentreGrid grid(centres, 2 * bounds.radius);
  RandomNumbers random(asked.seed);
  std::vector<Pose> poses;
  while (poses.size() < static_cast<std::size_t>(asked.count)) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    int attempt = 0;
    do {
      if (attempt++ == most_attempts) throw does_not_fit(body, asked, bounds.radius, poses.size());
      for (int axis = 0; axis < dimension; ++axis) centre[axis] = random.between(centres.min()[axis], centres.max()[axis]);
    } while (!grid.is_free(centre));
    grid.add(centre);
    Pose pose;
    if (asked.random_rotation) pose.rotation = dimension == 2 ? random.plane_rotation() : random.rotation();
    pose.translation = centre - pose.rotation * bounds.centre;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

std::vector<Pose> poses_of(const BodySpec& body, const Bounds& bounds, int dimension) {
  if (const auto* asked = std::get_if<AtPoses>(&body.arrangement)) return asked->poses;
  if (const auto* asked = std::get_if<OnLattice>(&body.arrangement)) return lattice(*asked, dimension);
  return at_random(body, std::get<AtRandom>(body.arrangement), bounds, dimension);
}

}  // namespace scree::mesh
