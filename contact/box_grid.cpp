#include "contact/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contact/lanes_in.h"
#include "engine/base/chunks.h"
#include "engine/base/grouped.h"

namespace scree::contact {

namespace {

// Cell edge in extents of a level's largest box. Smaller cells cost more rows, larger ones more tests.
constexpr double cell_per_extent = 1;
constexpr double slots_per_box = 4;

// So many values tell a median or a quantile well enough.
constexpr std::size_t sample_size = 1024;

// value(i) of some of [0, count).
template <class Value>
std::vector<double> sample(std::size_t count, const Value& value) {
  std::vector<double> values;
  const std::size_t stride = std::max<std::size_t>(1, count / sample_size);
  for (std::size_t i = 0; i < count; i += stride) values.push_back(value(i));
  return values;
}

// The one that so many others are below.
double ranked(std::vector<double>& values, std::size_t below) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(below), values.end());
  return values[below];
}

// Of what of(chunk) gives for every chunk of [0, count) the sum by join(sum, one), in order.
template <class Result, class Of, class Join>
Result over_chunks(std::size_t count, const Of& of, const Join& join) {
  std::vector<Result> parts(chunk_count(count));
  for_chunks(count, [&](Chunk chunk) { parts[chunk.number] = of(chunk); });
  Result all = parts[0];
  for (const Result& part : parts) join(all, part);
  return all;
}

double power_of_two(double at_least) {
  return static_cast<double>(std::bit_ceil(static_cast<std::uint64_t>(at_least)));
}

template <int dim>
double size_of(const Aabb<dim>& box) {
  return box.sizes().maxCoeff();
}

}  // namespace

template <int dim>
BoxGrid<dim>::BoxGrid(std::span<const Aabb<dim>> boxes) {
  if (boxes.empty()) return;
  const auto all = over_chunks<Aabb<dim>>(
      boxes.size(),
      [&](Chunk chunk) {
        Aabb<dim> some;
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) some.extend(boxes[i]);
        return some;
      },
      [](Aabb<dim>& sum, const Aabb<dim>& one) { sum.extend(one); });
  origin_ = all.min();
  order_.resize(boxes.size());
  packed_.resize(boxes.size() + 1);
  packed_.back() = {};
  for (const auto& members : by_size(boxes)) {
    if (!members.empty()) make_level(boxes, members);
  }
}

// The boxes of each level.
template <int dim>
std::vector<std::vector<std::uint32_t>> BoxGrid<dim>::by_size(std::span<const Aabb<dim>> boxes) {
  auto sizes = sample(boxes.size(), [&](std::size_t i) { return size_of<dim>(boxes[i]); });
  const double median = ranked(sizes, sizes.size() / 2);
  // The middle of a level is a factor two either way from its ends, so that one mesh size falls into one level.
  constexpr int levels = 256, middle = levels / 2;
  std::vector<std::uint8_t> level(boxes.size());
  for_chunks(boxes.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const double order = std::round(0.5 * std::log2(size_of<dim>(boxes[i]) / median));
      level[i] = static_cast<std::uint8_t>(std::clamp(order, 1.0 - middle, middle - 1.0) + middle);
    }
  });
  std::vector<std::vector<std::uint32_t>> members(levels);
  for (std::size_t i = 0; i < boxes.size(); ++i) members[level[i]].push_back(static_cast<std::uint32_t>(i));
  return members;
}

template <int dim>
void BoxGrid<dim>::make_level(std::span<const Aabb<dim>> boxes, const std::vector<std::uint32_t>& members) {
  Level level;
  level.first = levels_.empty() ? 0 : levels_.back().first + levels_.back().count;
  level.count = static_cast<std::uint32_t>(members.size());
  choose_cells(boxes, members, level);
  int bits = 0;
  for (const int b : level.bits) bits += b;
  VectorWrittenLater<std::uint32_t> slots(members.size());
  for_chunks(members.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) slots[i] = slot_of(level, boxes[members[i]]);
  });
  auto sorted = grouped_by_number<std::uint32_t, std::uint32_t>(
      members.size(), std::size_t{1} << bits, [&](std::size_t i, const auto& visit) { visit(slots[i], members[i]); });
  for_chunks(members.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      order_[level.first + i] = sorted.values[i];
      packed_[level.first + i] = pack(boxes[sorted.values[i]]);
    }
  });
  level.starts = std::move(sorted.begin);
  if (level.first != 0) {
    for (std::uint32_t& start : level.starts) start += level.first;
  }
  levels_.push_back(std::move(level));
}

// The region that holds all boxes but a few far ones, as a power of two of cells each way, none of them too empty.
template <int dim>
void BoxGrid<dim>::choose_cells(std::span<const Aabb<dim>> boxes, const std::vector<std::uint32_t>& members,
                                Level& level) const {
  const auto largest = over_chunks<Point<dim>>(
      members.size(),
      [&](Chunk chunk) {
        Point<dim> some = Point<dim>::Zero();
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) some = some.cwiseMax(boxes[members[i]].sizes());
        return some;
      },
      [](Point<dim>& sum, const Point<dim>& one) { sum = sum.cwiseMax(one).eval(); });
  std::array<double, dim> cells;
  for (int i = 0; i < dim; ++i) {
    level.largest[i] = largest[i];
    auto lows = sample(members.size(), [&](std::size_t m) { return boxes[members[m]].min()[i]; });
    const std::size_t few = lows.size() / 100;
    const double extent = ranked(lows, lows.size() - 1 - few) - ranked(lows, few);
    // A flat packing has no extent across.
    const double edge = std::max({cell_per_extent * level.largest[i], 1e-6 * extent, 1e-300});
    level.cells_per_metre[i] = 1 / edge;
    cells[i] = power_of_two(extent / edge + 1);
  }
  const double most = power_of_two(slots_per_box * static_cast<double>(members.size()));
  for (;;) {
    double product = 1;
    for (const double c : cells) product *= c;
    if (product <= most) break;
    *std::max_element(cells.begin(), cells.end()) /= 2;
  }
  for (int i = 0; i < dim; ++i) level.bits[i] = std::countr_zero(static_cast<std::uint64_t>(cells[i]));
}

template <int dim>
typename BoxGrid<dim>::Packed BoxGrid<dim>::pack(const Aabb<dim>& box) const {
  constexpr double rounding = 1.2e-7;  // twice that of a float
  Packed packed;
  for (int i = 0; i < dim; ++i) {
    const double low = box.min()[i] - origin_[i], high = box.max()[i] - origin_[i];
    packed.low[i] = static_cast<float>(low - rounding * std::abs(low));
    packed.below_high[i] = -static_cast<float>(high + rounding * std::abs(high));
  }
  return packed;
}

template <int dim>
std::uint32_t BoxGrid<dim>::slot_of(const Level& level, const Aabb<dim>& box) const {
  // From the packed corner, as in look_into.
  const Packed packed = pack(box);
  std::size_t slot = 0;
  for (int i = dim - 1; i >= 0; --i) {
    const auto cell = static_cast<std::int64_t>(std::floor(packed.low[i] * level.cells_per_metre[i]));
    slot = slot << level.bits[i] | (static_cast<std::size_t>(cell) & ((std::size_t{1} << level.bits[i]) - 1));
  }
  return static_cast<std::uint32_t>(slot);
}

template <int dim>
void BoxGrid<dim>::find(std::uint32_t place, Places& found) const {
  found.clear();
  const Packed& box = packed_[place];
  widely([&](auto bytes) SCREE_INLINED {
    for (const Level& level : levels_) {
      if (place >= level.first + level.count) continue;
      look_into<LanesIn<bytes>>(level, box, place < level.first ? level.first + level.count : place, found);
    }
  });
}

template <int dim>
void BoxGrid<dim>::find(const Aabb<dim>& box, Places& found) const {
  found.clear();
  const Packed packed = pack(box);
  widely([&](auto bytes) SCREE_INLINED {
    for (const Level& level : levels_) look_into<LanesIn<bytes>>(level, packed, level.first + level.count, found);
  });
}

template <int dim>
template <class Wide>
SCREE_INLINE void BoxGrid<dim>::look_into(const Level& level, const Packed& box, std::uint32_t before, Places& found) const {
  Cell low, count;
  for (int i = 0; i < dim; ++i) {
    constexpr double rounding = 1 + 1e-6;
    const double corner = box.low[i];
    const double from = corner - level.largest[i] * rounding - 1e-6 * std::abs(corner);
    low[i] = static_cast<std::int64_t>(std::floor(from * level.cells_per_metre[i]));
    const auto high = static_cast<std::int64_t>(std::floor(-box.below_high[i] * level.cells_per_metre[i]));
    count[i] = std::min(high - low[i] + 1, std::int64_t{1} << level.bits[i]);
  }
  const std::int64_t row_cells = std::int64_t{1} << level.bits[0];
  const std::int64_t begin = low[0] & (row_cells - 1);
  const std::int64_t end = begin + count[0];
  const std::int64_t planes = dim == 3 ? count[dim - 1] : 1;
  // What is above these in some lane does not meet the box.
  const auto limits =
      in_halves<Wide>([&](int) SCREE_INLINED { return -box.below_high; }, [&](int) SCREE_INLINED { return -box.low; });
  for (std::int64_t z = 0; z < planes; ++z) {
    for (std::int64_t y = 0; y < count[1]; ++y) {
      std::size_t row = static_cast<std::size_t>(low[1] + y) & ((std::size_t{1} << level.bits[1]) - 1);
      if constexpr (dim == 3) {
        row |= (static_cast<std::size_t>(low[2] + z) & ((std::size_t{1} << level.bits[2]) - 1)) << level.bits[1];
      }
      const std::uint32_t* starts = level.starts.data() + (row << level.bits[0]);
      test(starts[begin], std::min(starts[std::min(end, row_cells)], before), limits, found);
      if (end > row_cells) test(starts[0], std::min(starts[end - row_cells], before), limits, found);
    }
  }
}

// Without a branch for each box, which no one could foretell: a box that does not meet is written over.
template <int dim>
template <class Wide>
SCREE_INLINE void BoxGrid<dim>::test(std::uint32_t from, std::uint32_t to, const Wide& limits, Places& found) const {
  if (from >= to) return;
  constexpr std::uint32_t together = fours_of<Wide> / 2;
  const std::size_t count = found.size();
  found.resize(count + (to - from) + together);
  std::uint32_t* next = found.data() + count;
  for (std::uint32_t other = from; other < to; other += together) {
    Wide theirs;
    __builtin_memcpy(&theirs, &packed_[other], sizeof theirs);
    const unsigned apart = bits(below(limits, theirs));
    for_each_constant<together>([&](auto k) SCREE_INLINED {
      const bool meets = (apart >> 8 * k & 0xffu) == 0, is_asked = other + k < to;
      *next = other + k;
      next += static_cast<int>(meets) & static_cast<int>(is_asked);
    });
  }
  found.resize(static_cast<std::size_t>(next - found.data()));
}

template class BoxGrid<2>;
template class BoxGrid<3>;

}  // namespace scree::contact
