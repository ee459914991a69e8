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

// Mean heights over rings one block's size wide around the pile's middle.
std::vector<double> mean_profile(const Columns& columns) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double weight = 0;
  for (const Column& column : columns.lines) {
    middle += height(column) * column.place;
    weight += height(column);
  }
  if (weight > 0) middle /= weight;
  std::vector<double> sums, counts;
  for (const Column& column : columns.lines) {
    const auto ring = static_cast<std::size_t>((column.place - middle).norm() / columns.size);
    if (ring >= sums.size()) {
      sums.resize(ring + 1);
      counts.resize(ring + 1);
    }
    sums[ring] += height(column);
    ++counts[ring];
  }
  for (std::size_t ring = 0; ring < sums.size(); ++ring) sums[ring] /= std::max(1.0, counts[ring]);
  return sums;
}

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
  if (!(all > 0)) return std::nullopt;
  result.porosity = 1 - solid / all;
  result.volume = all * columns.spacing * columns.spacing;
  return result;
}

std::optional<Repose> angle_of_repose(const Columns& columns) {
  if (columns.lines.empty() || held_by_walls(columns)) return std::nullopt;
  const std::vector<double> profile = mean_profile(columns);
  const double highest = *std::max_element(profile.begin(), profile.end());
  Repose result;
  result.low = highest / 5;
  result.high = highest * 4 / 5;
  double r = 0, z = 0, rr = 0, rz = 0, n = 0;
  for (std::size_t ring = 0; ring < profile.size(); ++ring) {
    if (profile[ring] < result.low || profile[ring] > result.high) continue;
    const double radius = (static_cast<double>(ring) + 0.5) * columns.size;
    n += 1;
    r += radius;
    z += profile[ring];
    rr += radius * radius;
    rz += radius * profile[ring];
  }
  if (n < 3) return std::nullopt;
  result.rings = static_cast<std::size_t>(n);
  result.angle = std::atan(-(n * rz - r * z) / (n * rr - r * r));
  if (!(result.angle > 0)) return std::nullopt;
  return result;
}

}  // namespace scree::packing
