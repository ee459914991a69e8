#include "thermal/supernodal_factor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/base/check.h"
#include "engine/base/phases.h"

namespace scree::thermal {

namespace {

// The forest is cut into trees that take at most this part of the work. What is above them is shared less well.
constexpr int parts = 16;
constexpr std::int64_t flops_worth_sharing = 2'000'000;

// Of a supernode above the trees: large ones gain by large blocks, small ones by having more of them to share.
int columns_in_block(int rows) {
  return std::clamp(rows / 8, 192, 512);
}

std::int64_t product(std::int64_t a, std::int64_t b, std::int64_t c) {
  return a * b * c;
}

// Whether ascending numbers leave none out.
bool no_gaps(std::span<const int> numbers) {
  return numbers.back() - numbers.front() == static_cast<int>(numbers.size()) - 1;
}

}  // namespace

// One factorisation: what it reads and writes, whether all was well so far, and a space for each thread at work.
class SupernodalFactor::Work {
 public:
  Work(const double* from, double* to, std::size_t unknowns) : matrix(from), values(to), unknowns_(unknowns) {}

  std::unique_ptr<Space> take_space() {
    const std::lock_guard lock(turn_);
    if (free_.empty()) return std::make_unique<Space>(Space{std::vector<int>(unknowns_), {}, {}});
    std::unique_ptr<Space> space = std::move(free_.back());
    free_.pop_back();
    return space;
  }
  void give_back(std::unique_ptr<Space> space) {
    const std::lock_guard lock(turn_);
    free_.push_back(std::move(space));
  }

  const double* const matrix;
  double* const values;
  std::atomic<bool> sound = true;

 private:
  std::size_t unknowns_;
  std::mutex turn_;
  std::vector<std::unique_ptr<Space>> free_;
};

SupernodalFactor::SupernodalFactor(const SupernodalPattern& pattern, const Matrix& lower, const DenseKernels& kernels)
    : SupernodalFactor(pattern, lower, kernels, pattern.holders()) {}

SupernodalFactor::SupernodalFactor(const SupernodalPattern& pattern, const Matrix& lower, const DenseKernels& kernels,
                                   const std::vector<int>& holder)
    : pattern_(pattern),
      kernels_(kernels),
      updates_(find_updates(holder)),
      entries_(find_entries(holder, lower)),
      matrix_size_(lower.nonZeros()) {
  cut();
}

auto SupernodalFactor::find_updates(const std::vector<int>& holder) const -> PiecesOfRows<Update> {
  return PiecesOfRows<Update>(pattern_.supernodes, [&](const auto& visit) {
    for (int s = 0; s < pattern_.supernodes; ++s) {
      const int rows = pattern_.rows_of(s);
      for (int begin = pattern_.columns_of(s); begin < rows;) {
        const int target = holder[pattern_.row(s, begin)];
        int end = begin + 1;
        while (end < rows && holder[pattern_.row(s, end)] == target) ++end;
        visit(target, Update{s, begin, end});
        begin = end;
      }
    }
  });
}

auto SupernodalFactor::find_entries(const std::vector<int>& holder, const Matrix& lower) const -> PiecesOfRows<Entry> {
  std::vector<int> position(pattern_.unknowns);
  for (int i = 0; i < pattern_.unknowns; ++i) position[pattern_.permutation[i]] = i;
  const auto place_of = [&](int s, int column, int row) {
    const int* rows = pattern_.rows + pattern_.rows_begin[s];
    const auto place = static_cast<int>(std::lower_bound(rows, rows + pattern_.rows_of(s), row) - rows);
    return pattern_.values_begin[s] + (column - pattern_.first[s]) * pattern_.rows_of(s) + place;
  };
  return PiecesOfRows<Entry>(pattern_.supernodes, [&](const auto& visit) {
    int number = 0;
    for (int column = 0; column < lower.outerSize(); ++column) {
      for (Matrix::InnerIterator entry(lower, column); entry; ++entry, ++number) {
        const auto [c, r] = std::minmax(position[entry.row()], position[column]);
        visit(holder[c], Entry{place_of(holder[c], c, r), number});
      }
    }
  });
}

// Of what is gathered and divided for each supernode.
std::vector<std::int64_t> SupernodalFactor::flops() const {
  std::vector<std::int64_t> flops(pattern_.supernodes);
  for (int s = 0; s < pattern_.supernodes; ++s) {
    const int columns = pattern_.columns_of(s);
    flops[s] = product(columns, columns, pattern_.rows_of(s));
    for (const Update& update : updates_.of(s)) {
      const int rows = pattern_.rows_of(update.source) - update.begin;
      flops[s] += 2 * product(pattern_.columns_of(update.source), update.end - update.begin, rows);
    }
  }
  return flops;
}

// Phases: the trees and, beside them, the matrix in what is above them; then for each block its rows, some at a time, its
// corner, and its rows again.
void SupernodalFactor::cut() {
  forest_ = cut_forest(pattern_, flops(), parts, flops_worth_sharing);
  sizes_ = {static_cast<int>(forest_.trees.size() + forest_.top.size())};
  for (const int s : forest_.top) {
    const int rows = pattern_.rows_of(s), columns = pattern_.columns_of(s), wide = columns_in_block(rows);
    const int rows_in_piece = 2 * wide;
    for (int begin = 0; begin < columns; begin += wide) {
      const int end = std::min(columns, begin + wide);
      blocks_.push_back({s, {begin, end}, rows_in_piece});
      const int pieces = (rows - end + rows_in_piece - 1) / rows_in_piece;
      sizes_.insert(sizes_.end(), {1 + pieces, 1, pieces});
    }
  }
}

bool SupernodalFactor::factorise(const Matrix& lower, double* values) const {
  SCREE_EXPECT(lower.isCompressed() && lower.nonZeros() == matrix_size_);
  Work work(lower.valuePtr(), values, pattern_.unknowns);
  run_phases(
      sizes_, 1, [&](int phase, int task) { run(phase, task, work); }, kernels_.at_once);
  return work.sound;
}

void SupernodalFactor::run(int phase, int task, Work& work) const {
  if (!work.sound) return;
  std::unique_ptr<Space> space = work.take_space();
  if (phase == 0) {
    const auto trees = static_cast<int>(forest_.trees.size());
    if (task < trees) {
      factorise_tree(forest_.trees[task], work, *space);
    } else {
      assemble(forest_.top[task - trees], work.matrix, work.values);
    }
  } else {
    const Block& block = blocks_[(phase - 1) / 3];
    const int step = (phase - 1) % 3;
    if (step == 0 && task == 0) {
      gather_corner(block, work.values, *space);
    } else if (step == 0) {
      gather_rows(block, rows_of_piece(block, task - 1), work.values, *space);
    } else if (step == 1) {
      if (!factorise_corner(block, work.values)) work.sound = false;
    } else {
      divide_rows(block, rows_of_piece(block, task), work.values);
    }
  }
  work.give_back(std::move(space));
}

void SupernodalFactor::factorise_tree(const CutForest::Tree& tree, Work& work, Space& space) const {
  for (const int s : tree.supernodes) {
    const Span below{pattern_.columns_of(s), pattern_.rows_of(s)};
    const Block whole{s, {0, below.begin}, below.end};
    assemble(s, work.matrix, work.values);
    gather_corner(whole, work.values, space);
    gather_rows(whole, below, work.values, space);
    if (!factorise_corner(whole, work.values)) {
      work.sound = false;
      return;
    }
    divide_rows(whole, below, work.values);
  }
}

Span SupernodalFactor::rows_of_piece(const Block& block, int piece) const {
  const int begin = block.columns.end + piece * block.rows_in_piece;
  return {begin, std::min(pattern_.rows_of(block.supernode), begin + block.rows_in_piece)};
}

void SupernodalFactor::assemble(int s, const double* matrix, double* values) const {
  std::fill(values + pattern_.values_begin[s], values + pattern_.values_begin[s + 1], 0.0);
  for (const Entry& entry : entries_.of(s)) values[entry.place] += matrix[entry.number];
}

template <class Visit>
void SupernodalFactor::for_each_source(const Block& block, const double* values, const Visit& visit) const {
  const int s = block.supernode;
  const auto rows_of = [&](int t) {
    return std::span(pattern_.rows + pattern_.rows_begin[t], static_cast<std::size_t>(pattern_.rows_of(t)));
  };
  const int first = pattern_.first[s] + block.columns.begin, last = pattern_.first[s] + block.columns.end;
  for (const Update& update : updates_.of(s)) {
    const std::span<const int> rows = rows_of(update.source);
    const auto place = [&](int row) {
      return static_cast<int>(std::lower_bound(rows.begin() + update.begin, rows.begin() + update.end, row) - rows.begin());
    };
    const int begin = place(first), end = place(last);
    if (begin == end) continue;
    visit(Source{values + pattern_.values_begin[update.source], pattern_.columns_of(update.source), rows, begin, end});
  }
  if (block.columns.begin == 0) return;
  visit(Source{values + pattern_.values_begin[s], block.columns.begin, rows_of(s), block.columns.begin, block.columns.end});
}

// Where the rows have no gaps the products are subtracted in place, else one by one.
void SupernodalFactor::gather_corner(const Block& block, double* values, Space& space) const {
  const int s = block.supernode, ld = pattern_.rows_of(s);
  double* corner = values + pattern_.values_begin[s];
  for_each_source(block, values, [&](const Source& source) {
    const auto rows = source.rows.subspan(source.begin, source.end - source.begin);
    const auto count = static_cast<int>(rows.size()), source_ld = static_cast<int>(source.rows.size());
    const double* from = source.values + source.begin;
    const auto place = [&](int row) { return row - pattern_.first[s]; };
    if (no_gaps(rows)) {
      double* to = corner + static_cast<std::size_t>(place(rows[0])) * ld + place(rows[0]);
      return kernels_.square(count, source.columns, -1, from, source_ld, 1, to, ld);
    }
    space.products.resize(std::max(space.products.size(), rows.size() * rows.size()));
    double* products = space.products.data();
    kernels_.square(count, source.columns, 1, from, source_ld, 0, products, count);
    for (int j = 0; j < count; ++j, products += count) {
      double* to = corner + static_cast<std::size_t>(place(rows[j])) * ld;
      for (int i = j; i < count; ++i) to[place(rows[i])] -= products[i];
    }
  });
}

void SupernodalFactor::gather_rows(const Block& block, Span below, double* values, Space& space) const {
  if (below.begin == below.end) return;
  const int s = block.supernode, ld = pattern_.rows_of(s);
  const int* own_rows = pattern_.rows + pattern_.rows_begin[s];
  for (int i = below.begin; i < below.end; ++i) space.place[own_rows[i]] = i;
  const int first = own_rows[below.begin], last = own_rows[below.end - 1] + 1;
  double* to = values + pattern_.values_begin[s];
  for_each_source(block, values, [&](const Source& source) {
    const auto columns = source.rows.subspan(source.begin, source.end - source.begin);
    const auto begin = std::lower_bound(source.rows.begin() + source.end, source.rows.end(), first);
    const auto end = std::lower_bound(begin, source.rows.end(), last);
    if (begin == end) return;
    const auto rows = static_cast<int>(end - begin), count = static_cast<int>(columns.size());
    const auto source_ld = static_cast<int>(source.rows.size());
    const double* from = source.values + (begin - source.rows.begin());
    const double* across = source.values + source.begin;
    const auto column = [&](int j) { return to + static_cast<std::size_t>(columns[j] - pattern_.first[s]) * ld; };
    const int top = space.place[*begin];
    if (space.place[end[-1]] - top == rows - 1 && no_gaps(columns)) {
      return kernels_.multiply(rows, count, source.columns, -1, from, source_ld, across, source_ld, 1, column(0) + top, ld);
    }
    space.products.resize(std::max(space.products.size(), static_cast<std::size_t>(rows) * count));
    space.places.resize(std::max(space.places.size(), static_cast<std::size_t>(rows)));
    double* products = space.products.data();
    int* places = space.places.data();
    std::transform(begin, end, places, [&](int row) { return space.place[row]; });
    kernels_.multiply(rows, count, source.columns, 1, from, source_ld, across, source_ld, 0, products, rows);
    for (int j = 0; j < count; ++j, products += rows) {
      double* here = column(j);
      for (int i = 0; i < rows; ++i) here[places[i]] -= products[i];
    }
  });
}

bool SupernodalFactor::factorise_corner(const Block& block, double* values) const {
  const int ld = pattern_.rows_of(block.supernode), begin = block.columns.begin, count = block.columns.end - begin;
  double* corner = values + pattern_.values_begin[block.supernode] + static_cast<std::size_t>(begin) * ld + begin;
  // What is not a number is told by no kernel, but spreads to the last.
  return kernels_.factorise(count, corner, ld) && std::isfinite(corner[static_cast<std::size_t>(count - 1) * (ld + 1)]);
}

void SupernodalFactor::divide_rows(const Block& block, Span rows, double* values) const {
  if (rows.begin == rows.end) return;
  const int ld = pattern_.rows_of(block.supernode), begin = block.columns.begin;
  double* column = values + pattern_.values_begin[block.supernode] + static_cast<std::size_t>(begin) * ld;
  kernels_.divide(rows.end - rows.begin, block.columns.end - begin, column + begin, ld, column + rows.begin, ld);
}

}  // namespace scree::thermal
