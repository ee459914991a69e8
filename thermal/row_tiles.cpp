#include "thermal/row_tiles.h"

namespace scree::thermal {

namespace {

constexpr std::int64_t work_in_tile = 65'536;
constexpr std::size_t stretches_in_task = 2;
// Of 2 * depth tiles that are to stay in the cache between two products: 12 bytes an entry, and a third as much of vectors.
constexpr std::int64_t work_in_cache = 2'000'000;
constexpr int most_depth = 4;
// Less K than this stays in the cache by itself.
constexpr std::int64_t much_work = 1'000'000;

}  // namespace

RowTiles::RowTiles(const std::vector<RowStretch>& stretches) : ends_{0} {
  std::int64_t all = 0, work = 0;
  int needed = 0;  // row that the tile must reach: the columns of the tile before
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    work += stretches[i].work;
    if ((work < work_in_tile || stretches[i].end < needed) && i + 1 < stretches.size()) continue;
    needed = stretches[i].reach;
    ends_.push_back(i + 1);
    all += work;
    work = 0;
  }
  if (all < much_work) return;
  depth_ = static_cast<int>(std::clamp<std::int64_t>(work_in_cache * tiles() / (2 * all), 1, most_depth));
}

int RowTiles::tasks_of_tile(int tile) const {
  if (tile < 0 || tile >= tiles()) return 0;
  const std::size_t stretches = ends_[tile + 1] - ends_[tile];
  return static_cast<int>((stretches + stretches_in_task - 1) / stretches_in_task);
}

std::vector<int> RowTiles::tasks(int depth) const {
  std::vector<int> sizes(static_cast<std::size_t>(tiles() + 2 * (depth - 1)), 0);
  for (int phase = 0; phase < std::ssize(sizes); ++phase) {
    for (int product = 0; product < depth; ++product) sizes[phase] += tasks_of_tile(phase - 2 * product);
  }
  return sizes;
}

RowTiles::Task RowTiles::task(int depth, int phase, int number) const {
  int product = 0;
  for (; product + 1 < depth; ++product) {
    const int tasks = tasks_of_tile(phase - 2 * product);
    if (number < tasks) break;
    number -= tasks;
  }
  const int tile = phase - 2 * product;
  const std::size_t begin = ends_[tile] + number * stretches_in_task;
  return {product, begin, std::min(begin + stretches_in_task, ends_[tile + 1])};
}

}  // namespace scree::thermal
