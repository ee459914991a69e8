#include "contact/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "contact/lanes_in.h"

namespace scree::contact {

namespace {

// Cell edge in extents of a level's largest box. Smaller cells cost more rows, larger ones more tests.
constexpr double cell_per_extent = 1;
constexpr double slots_per_box = 4;

// So many values tell a median or a quantile well enough.
constexpr std::size_t sample_size = 1024;

template <class Value>
std::vector<double> sample(std::size_t count, const Value& value) {
  std::vector<double> values;
  const std::size_t stride = std::max<std::size_t>(1, count / sample_size);
  for (std::size_t i = 0; i < count; i += stride) values.push_back(value(i));
  std::sort(values.begin(), values.end());
  return values;
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
  Aabb<dim> all;
  for (const auto& box : boxes) all.extend(box);
  origin_ = all.min();
  const auto sizes = sample(boxes.size(), [&](std::size_t i) { return size_of<dim>(boxes[i]); });
  const double median = sizes[sizes.size() / 2];
  // The middle of a level is a factor two either way from its ends, so that one mesh size falls into one level.
  constexpr int orders = 256;
  std::array<std::vector<std::uint32_t>, orders> members;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double order = std::round(0.5 * std::log2(size_of<dim>(boxes[i]) / median));
    members[static_cast<std::size_t>(std::clamp(order, -127.0, 127.0)) + orders / 2].push_back(static_cast<std::uint32_t>(i));
  }
  order_.resize(boxes.size());
  packed_.resize(boxes.size() + 1);
  packed_.back() = {};
  for (auto& level : members) {
    if (!level.empty()) make_level(boxes, std::move(level));
  }
}

template <int dim>
void BoxGrid<dim>::make_level(std::span<const Aabb<dim>> boxes, std::vector<std::uint32_t> members) {
  Level level;
  level.first = levels_.empty() ? 0 : levels_.back().first + levels_.back().count;
  level.count = static_cast<std::uint32_t>(members.size());
  choose_cells(boxes, members, level);
  int bits = 0;
  for (const int b : level.bits) bits += b;
  level.starts.assign((std::size_t{1} << bits) + 1, 0);
  std::vector<std::uint32_t> slots;
  slots.reserve(members.size());
  for (const auto i : members) {
    slots.push_back(static_cast<std::uint32_t>(slot_of(level, boxes[i])));
    ++level.starts[slots.back() + 1];
  }
  level.starts[0] = level.first;
  for (std::size_t slot = 1; slot < level.starts.size(); ++slot) level.starts[slot] += level.starts[slot - 1];
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::uint32_t place = level.starts[slots[i]]++;
    order_[place] = members[i];
    packed_[place] = pack(boxes[members[i]]);
  }
  // Each start has moved to its slot's end.
  for (std::size_t slot = level.starts.size() - 1; slot > 0; --slot) level.starts[slot] = level.starts[slot - 1];
  level.starts[0] = level.first;
  levels_.push_back(std::move(level));
}

// The region that holds all boxes but a few far ones, as a power of two of cells each way, none of them too empty.
template <int dim>
void BoxGrid<dim>::choose_cells(std::span<const Aabb<dim>> boxes, const std::vector<std::uint32_t>& members,
                                Level& level) const {
  std::array<double, dim> cells;
  for (int i = 0; i < dim; ++i) {
    for (const auto m : members) level.largest[i] = std::max(level.largest[i], boxes[m].sizes()[i]);
    const auto lows = sample(members.size(), [&](std::size_t m) { return boxes[members[m]].min()[i]; });
    const double extent = lows[lows.size() - 1 - lows.size() / 100] - lows[lows.size() / 100];
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
std::size_t BoxGrid<dim>::slot_of(const Level& level, const Aabb<dim>& box) const {
  // From the packed corner, as in look_into.
  const Packed packed = pack(box);
  std::size_t slot = 0;
  for (int i = dim - 1; i >= 0; --i) {
    const auto cell = static_cast<std::int64_t>(std::floor(packed.low[i] * level.cells_per_metre[i]));
    slot = slot << level.bits[i] | (static_cast<std::size_t>(cell) & ((std::size_t{1} << level.bits[i]) - 1));
  }
  return slot;
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
