// Random numbers that are the same with every standard library: the standard fixes std::mt19937_64, but not what its
// distributions make of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

namespace scree::mesh {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : bits_(seed) {}

  // In [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

  double between(double low, double high) { return low + (high - low) * unit(); }

  // Uniform over all rotations: Shoemake, "Uniform random rotations", Graphics Gems III (1992), p. 124.
  Eigen::Quaterniond rotation() {
    const double u = unit(), a = between(0, 2 * std::numbers::pi), b = between(0, 2 * std::numbers::pi);
    const double s = std::sqrt(1 - u), c = std::sqrt(u);
    return {c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b)};
  }

  // Uniform over the rotations of the plane.
  Eigen::Quaterniond plane_rotation() {
    const double half = between(0, std::numbers::pi);
    return {std::cos(half), 0, 0, std::sin(half)};
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace scree::mesh
