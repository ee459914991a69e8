#include "thermal/row_runs.h"

#include <algorithm>
#include <span>

namespace scree::thermal {

namespace {

// Wider instructions where the processor has them. Without fused operations they round like the plain ones. (With AVX-512 it
// takes twice as long: most of its loads cross a cache line.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SCREE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SCREE_WIDE
#endif

#define SCREE_INLINE inline __attribute__((always_inline))

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
    // The processor's own prefetching ends at pages and does not keep up with rows as short as these.
    constexpr int ahead = 256;
    __builtin_prefetch(value + run.begin + ahead);
    __builtin_prefetch(value + run.begin + ahead + 8);
    __builtin_prefetch(column + run.begin + ahead);
    const int numbers = columns * run.rows;
    int at = 0;
    for (; at + 4 <= numbers; at += 4) flow_of<columns, 4>(run, column, value, x, at, flow);
    for (; at < numbers; at += columns) flow_of<columns, columns>(run, column, value, x, at, flow);
    flow += numbers;
  }
}

SCREE_WIDE void single(std::span<const RowRun> runs, const int* column, const double* value, const double* x, double* flow) {
  flows_of<1>(runs, column, value, x, flow);
}

SCREE_WIDE void twin(std::span<const RowRun> runs, const int* column, const double* value, const double* x, double* flow) {
  flows_of<2>(runs, column, value, x, flow);
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

RowRuns::RowRuns(const Eigen::SparseMatrix<double>& matrix) : column_(matrix.innerIndexPtr()), value_(matrix.valuePtr()) {
  const int* outer = matrix.outerIndexPtr();
  int rows = 0;  // of the part that grows
  for (int row = 0; row < static_cast<int>(matrix.rows()); ++row) {
    const bool goes_on = row > 0 && repeats(matrix, row) && runs_.back().rows < rows_in_run;
    if (goes_on) {
      ++runs_.back().rows;
    } else {
      if (rows >= rows_in_part) rows = 0;
      if (rows == 0) parts_.push_back({runs_.size(), runs_.size()});
      runs_.push_back({row, 1, outer[row], outer[row + 1] - outer[row]});
      ++parts_.back().end;
    }
    ++rows;
  }
}

template <>
void RowRuns::flows<1>(const Part& part, const double* x, double* flow) const {
  single(std::span(runs_).subspan(part.begin, part.end - part.begin), column_, value_, x, flow);
}

template <>
void RowRuns::flows<2>(const Part& part, const double* x, double* flow) const {
  twin(std::span(runs_).subspan(part.begin, part.end - part.begin), column_, value_, x, flow);
}

}  // namespace scree::thermal
