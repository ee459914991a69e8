#include "engine/packing/bulk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::packing {

namespace {

double common_length(const std::vector<Interval>& intervals, const Interval& part) {
  double length = 0;
  for (const Interval& interval : intervals) {
    length += std::max(0.0, std::min(interval.high, part.high) - std::max(interval.low, part.low));
  }
  return length;
}

double height(const Column& column) {
  return column.top ? *column.top - column.floor : 0;
}

// Does a fixed block stand beside the pile, higher than one block above the pile's floor there? One that begins above the pile,
// such as the hopper it was poured from, holds nothing.
bool held_by_walls(const Columns& columns) {
  for (std::size_t i = 0; i < columns.lines.size(); ++i) {
    const Column& column = columns.lines[i];
    if (!column.top) continue;
    const auto holds = [&](const Interval& fixed) {
      return fixed.high > column.floor + columns.size && fixed.low < *column.top;
    };
    for (const std::size_t near : columns.near(i, columns.size)) {
      const auto& fixed = columns.lines[near].fixed;
      if (std::any_of(fixed.begin(), fixed.end(), holds)) return true;
    }
  }
  return false;
}

Eigen::Vector2d middle_of(const Columns& columns) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double weight = 0;
  for (const Column& column : columns.lines) {
    middle += height(column) * column.place;
    weight += height(column);
  }
  return weight > 0 ? Eigen::Vector2d(middle / weight) : middle;
}

// Heights of the lines in a ring around the pile's middle.
struct Ring {
  double radius = 0;  // [m]
  double lines = 0;
  double sum = 0;      // [m]
  double squares = 0;  // [m2]

  [[nodiscard]] double mean() const { return lines > 0 ? sum / lines : 0; }
};

// One block's size wide.
std::vector<Ring> rings_of(const Columns& columns) {
  const Eigen::Vector2d middle = middle_of(columns);
  std::vector<Ring> rings;
  for (const Column& column : columns.lines) {
    const auto number = static_cast<std::size_t>((column.place - middle).norm() / columns.size);
    while (rings.size() <= number) rings.push_back({.radius = (static_cast<double>(rings.size()) + 0.5) * columns.size});
    Ring& ring = rings[number];
    ++ring.lines;
    ring.sum += height(column);
    ring.squares += height(column) * height(column);
  }
  return rings;
}

struct Line {
  double at_middle = 0;  // [m]
  double slope = 0;      // [-]
};

// Through the mean heights of the rings, each of which counts the same.
Line line_through(const std::vector<Ring>& rings) {
  double r = 0, z = 0, rr = 0, rz = 0;
  for (const Ring& ring : rings) {
    r += ring.radius;
    z += ring.mean();
    rr += ring.radius * ring.radius;
    rz += ring.radius * ring.mean();
  }
  const auto n = static_cast<double>(rings.size());
  const double slope = (n * rz - r * z) / (n * rr - r * r);
  return {(z - slope * r) / n, slope};
}

// The part of the variance of all heights in the rings that goes with the line [-].
double fit_of(const Line& line, const std::vector<Ring>& rings) {
  double lines = 0, sum = 0, squares = 0, left = 0;
  for (const Ring& ring : rings) {
    const double expected = line.at_middle + line.slope * ring.radius;
    lines += ring.lines;
    sum += ring.sum;
    squares += ring.squares;
    left += ring.squares - 2 * expected * ring.sum + expected * expected * ring.lines;
  }
  return 1 - left / (squares - sum * sum / lines);
}

// Below it what the rings mean is no flank: two heaps have 0.0 to 0.4, a layer 0.1, a ridge three times as long as wide 0.4, a
// cone of six blocks' height, whose surface is as rough as its blocks are large, 0.6 and more.
constexpr double least_fit = 0.5;

}  // namespace

std::optional<Interval> inner_part(const Columns& columns, std::size_t line) {
  Interval part{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (!columns.lines[line].top) return std::nullopt;
  for (const std::size_t near : columns.near(line, columns.size)) {
    const Column& column = columns.lines[near];
    if (!column.top) return std::nullopt;
    part.low = std::max(part.low, column.floor + columns.size);
    part.high = std::min(part.high, *column.top - columns.size);
  }
  if (!(part.high > part.low)) return std::nullopt;
  return part;
}

std::optional<InnerPorosity> inner_porosity(const Columns& columns) {
  InnerPorosity result;
  result.margin = columns.size;
  double solid = 0;
  double all = 0;
  for (std::size_t i = 0; i < columns.lines.size(); ++i) {
    const auto part = inner_part(columns, i);
    if (!part) continue;
    const Column& column = columns.lines[i];
    ++result.lines;
    all += part->high - part->low - common_length(column.fixed, *part);
    solid += common_length(column.free, *part);
    for (const double z : {part->low, part->high}) {
      result.box.extend(Eigen::Vector3d(column.place.x(), column.place.y(), z));
    }
  }
  result.volume = all * columns.spacing * columns.spacing;
  // What is smaller than a block may lie between two.
  if (!(all > 0) || result.volume < std::pow(columns.size, 3)) return std::nullopt;
  result.porosity = 1 - solid / all;
  return result;
}

std::optional<Repose> angle_of_repose(const Columns& columns) {
  if (columns.lines.empty() || held_by_walls(columns)) return std::nullopt;
  std::vector<Ring> rings = rings_of(columns);
  const auto lower = [](const Ring& a, const Ring& b) { return a.mean() < b.mean(); };
  const double highest = std::max_element(rings.begin(), rings.end(), lower)->mean();
  Repose result;
  result.low = highest / 5;
  result.high = highest * 4 / 5;
  std::erase_if(rings, [&](const Ring& ring) { return ring.mean() < result.low || ring.mean() > result.high; });
  if (rings.size() < 3) return std::nullopt;
  const Line flank = line_through(rings);
  result.rings = rings.size();
  result.angle = std::atan(-flank.slope);
  result.fit = fit_of(flank, rings);
  if (!(result.angle > 0 && result.fit >= least_fit)) return std::nullopt;
  return result;
}

}  // namespace scree::packing
