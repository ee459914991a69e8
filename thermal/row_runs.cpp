#include "thermal/row_runs.h"

#include <algorithm>
#include <utility>

#include "thermal/wide.h"

namespace scree::thermal {

namespace {

// The flows of `width` numbers side by side, of which `at` is the first.
template <int columns, int width>
SCREE_INLINE void flow_of(const RowRun& run, const int* column, const double* value, const double* x, std::ptrdiff_t at,
                          double* flow) {
  const double* from = x + columns * static_cast<std::ptrdiff_t>(run.first) + at;
  double here[width], sum[width];
  for (int i = 0; i < width; ++i) here[i] = from[i];
  for (int i = 0; i < width; ++i) sum[i] = 0;
  for (int k = run.begin; k < run.begin + run.entries; ++k) {
    const double* there = x + columns * static_cast<std::ptrdiff_t>(column[k]) + at;
    for (int i = 0; i < width; ++i) sum[i] += value[k] * (there[i] - here[i]);
  }
  for (int i = 0; i < width; ++i) flow[at + i] = sum[i];
}

template <int columns>
SCREE_INLINE void flows_of(std::span<const RowRun> runs, const int* column, const double* value, const double* x,
                           double* flow) {
  for (const RowRun& run : runs) {
    fetch_ahead(column + run.begin, value + run.begin);
    const int numbers = columns * run.rows;
    int at = 0;
    // Sums wait for their own last addition only: four of them side by side, and each value is read for all.
    constexpr int wide = 4 * numbers_in_quad;
    for (; at + wide <= numbers; at += wide) flow_of<columns, wide>(run, column, value, x, at, flow);
    for (; at + numbers_in_quad <= numbers; at += numbers_in_quad) {
      flow_of<columns, numbers_in_quad>(run, column, value, x, at, flow);
    }
    for (; at < numbers; at += columns) flow_of<columns, columns>(run, column, value, x, at, flow);
    flow += numbers;
  }
}

// Whether row `row` is the one before, moved along by one.
bool repeats(const Eigen::SparseMatrix<double>& matrix, Eigen::Index row) {
  const int* outer = matrix.outerIndexPtr();
  const int before = outer[row - 1], begin = outer[row], end = outer[row + 1];
  if (end - begin != begin - before) return false;
  for (int k = 0; k < end - begin; ++k) {
    if (matrix.innerIndexPtr()[begin + k] != matrix.innerIndexPtr()[before + k] + 1) return false;
  }
  return std::equal(matrix.valuePtr() + begin, matrix.valuePtr() + end, matrix.valuePtr() + before);
}

}  // namespace

RowRuns::RowRuns(const Eigen::SparseMatrix<double>& matrix)
    : begin_(matrix.outerIndexPtr()), column_(matrix.innerIndexPtr()), value_(matrix.valuePtr()) {
  const int end = static_cast<int>(matrix.rows());
  for (int row = 0; row < end;) {
    if (bundles_.add(matrix, row)) {
      add_bundle(row);
      row += rows_in_bundle;
      continue;
    }
    RowRun run{row, 1, begin_[row], begin_[row + 1] - begin_[row]};
    while (run.rows < rows_in_run && row + run.rows < end && repeats(matrix, row + run.rows)) ++run.rows;
    add_run(run);
    row += run.rows;
  }
  close_part();
}

// The one that was added last.
void RowRuns::add_bundle(int row) {
  Part& part = open_part(row, Kind::bundled);
  part.end = bundles_.count();
  part.rows += rows_in_bundle;
  part.work += 2 * static_cast<std::int64_t>(bundles_[part.end - 1].columns);
}

void RowRuns::add_run(const RowRun& run) {
  ++count_;
  Part& part = open_part(run.first, Kind::repeating);
  runs_.push_back(run);
  part.end = runs_.size();
  part.rows += run.rows;
  // Rows that repeat take a quarter of the time.
  part.work += run.entries * static_cast<std::int64_t>(run.rows + 3) / 4;
}

// The part that the next rows belong to.
RowRuns::Part& RowRuns::open_part(int row, Kind kind) {
  const bool full =
      parts_.empty() || parts_.back().kind != kind || parts_.back().rows >= rows_in_part || parts_.back().work >= work_in_part;
  if (full) {
    close_part();
    const std::size_t next = kind == Kind::bundled ? bundles_.count() - 1 : runs_.size();
    parts_.push_back({row, 0, kind, next, next, 0});
  }
  return parts_.back();
}

// Where none of its rows repeats, no runs need be kept.
void RowRuns::close_part() {
  if (parts_.empty()) return;
  Part& last = parts_.back();
  if (last.kind == Kind::bundled || static_cast<std::size_t>(last.rows) > last.end - last.begin) return;
  last.kind = Kind::lone;
  runs_.resize(last.begin);
}

std::span<const RowRuns::Part> RowRuns::parts_of_task(int task, int threads) const {
  constexpr int pieces = 4 * (tasks_a_thread - 1);  // of a share: as many small tasks are a quarter of it
  constexpr int large = 3 * pieces / 4;
  const int share = task / tasks_a_thread;
  const int round = task % tasks_a_thread;
  const auto place = [&](int piece) {
    return parts_.size() * static_cast<std::size_t>(share * pieces + piece) / static_cast<std::size_t>(threads * pieces);
  };
  const std::size_t begin = place(round == 0 ? 0 : large + round - 1);
  const std::size_t end = place(large + round);
  return std::span(parts_).subspan(begin, end - begin);
}

template <>
SCREE_WIDE void RowRuns::flows<1>(const Part& part, const double* x, double* flow) const {
  flows_of<1>(std::span(runs_).subspan(part.begin, part.end - part.begin), column_, value_, x, flow);
}

template <>
SCREE_WIDE void RowRuns::flows<2>(const Part& part, const double* x, double* flow) const {
  flows_of<2>(std::span(runs_).subspan(part.begin, part.end - part.begin), column_, value_, x, flow);
}

}  // namespace scree::thermal
