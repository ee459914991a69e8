// Rows of K that repeat. In a grid of equal cells most rows are the one before, moved along by one node: the same values at
// columns that are each one further. Such rows are multiplied together, several nodes to an instruction, and their values are
// read once: in a grid a product then costs a fifth of what reading K for each row does. Elsewhere a run is one row long, and
// rows are read from K as they stand, but for the rows of small blocks, which are bundled (row_bundles.h).
//
// The flows of a row are summed in the order of its columns whatever the run, so how rows are grouped, and how wide the
// processor's instructions are, does not change a bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/base/phases.h"
#include "engine/base/threads.h"
#include "thermal/row_bundles.h"

namespace scree::thermal {

struct RowRun {
  int first;    // row
  int rows;     // at least one
  int begin;    // of its entries in K, those of the first row
  int entries;  // of a row
};

// The processor's own prefetching ends at pages and does not keep up with rows as short as these: asked for is as much as most
// rows have, as far ahead as it takes the memory to answer. In a loop over just what a row has it would cost more than it
// gives.
inline void fetch_ahead(const int* column, const double* value) {
  constexpr int ahead = 768;  // entries
  constexpr int values_in_line = 8, columns_in_line = 16;
  for (int line = 0; line < 4; ++line) __builtin_prefetch(value + ahead + line * values_in_line);
  for (int line = 0; line < 2; ++line) __builtin_prefetch(column + ahead + line * columns_in_line);
}

class RowRuns {
 public:
  // Refers to the matrix, which is symmetric to the bit: its columns are its rows.
  explicit RowRuns(const Eigen::SparseMatrix<double>& matrix);

  // Calls use(row, flow) for every row i, in no order of note and on all threads: flow[c] is the sum over j of K_ij (x_jc -
  // x_ic), for `columns` columns of x that lie side by side.
  template <int columns, class Use>
  void for_each_flow(const double* x, const Use& use) const;

  // The same; rows_of(first, rows) is asked for what is to be called with each of these rows and its flow.
  template <int columns, class RowsOf>
  void for_each_part(const double* x, const RowsOf& rows_of) const;

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t bundles() const { return bundles_.count(); }

 private:
  enum class Kind { lone, repeating, bundled };

  // Consecutive rows that are worked off together, each part about as long as another.
  struct Part {
    int first, rows;
    Kind kind;
    std::size_t begin, end;  // of its runs or bundles
    std::int64_t work;       // entries that are read
  };
  static constexpr int rows_in_part = 512;
  static constexpr int rows_in_run = 128;
  static constexpr std::int64_t work_in_part = 8192;
  static constexpr int tasks_a_thread = 5;

  [[nodiscard]] long rows() const { return parts_.empty() ? 0 : parts_.back().first + parts_.back().rows; }
  void add_bundle(int row);
  void add_run(const RowRun& run);
  Part& open_part(int row, Kind kind);
  void close_part();

  // Each thread has a share of the rows, in consecutive tasks, which run_phases deals out to it. The first is three quarters of
  // the share, for a thread that takes the same one in every product finds it in its cache; the others are small and even out
  // who is done first.
  [[nodiscard]] std::span<const Part> parts_of_task(int task, int threads) const;

  // The flows of rows that repeat, one after another.
  template <int columns>
  void flows(const Part& part, const double* x, double* flow) const;

  template <int columns, class Use>
  void work_off(const Part& part, const double* x, const Use& use) const;
  template <int columns, class Use>
  void work_off_lone(const Part& part, const double* x, const Use& use) const;

  const int* begin_;  // of the entries of each row
  const int* column_;
  const double* value_;
  std::size_t count_ = 0;
  std::vector<RowRun> runs_;  // of the parts that repeat
  RowBundles bundles_;
  std::vector<Part> parts_;
};

template <>
void RowRuns::flows<1>(const Part& part, const double* x, double* flow) const;
template <>
void RowRuns::flows<2>(const Part& part, const double* x, double* flow) const;

template <int columns, class Use>
void RowRuns::work_off_lone(const Part& part, const double* x, const Use& use) const {
  using Flow = Eigen::Array<double, columns, 1>;
  const auto at = [x](int row) { return Eigen::Map<const Flow>(x + columns * static_cast<std::ptrdiff_t>(row)); };
  int entry = begin_[part.first];
  for (int row = part.first; row < part.first + part.rows; ++row) {
    fetch_ahead(column_ + entry, value_ + entry);
    const Flow here = at(row);
    Flow flow = Flow::Zero();
    for (const int end = begin_[row + 1]; entry < end; ++entry) flow += value_[entry] * (at(column_[entry]) - here);
    use(row, flow.data());
  }
}

template <int columns, class Use>
void RowRuns::work_off(const Part& part, const double* x, const Use& use) const {
  if (part.kind == Kind::lone) return work_off_lone<columns>(part, x, use);
  double flow[columns * (rows_in_part + rows_in_run)];
  if (part.kind == Kind::bundled) {
    bundles_.flows<columns>(part.begin, part.end, x, flow);
  } else {
    flows<columns>(part, x, flow);
  }
  for (int i = 0; i < part.rows; ++i) use(part.first + i, flow + columns * i);
}

template <int columns, class Use>
void RowRuns::for_each_flow(const double* x, const Use& use) const {
  for_each_part<columns>(x, [&use](int, int) -> const Use& { return use; });
}

template <int columns, class RowsOf>
void RowRuns::for_each_part(const double* x, const RowsOf& rows_of) const {
  const auto take = [&](const Part& part) { work_off<columns>(part, x, rows_of(part.first, part.rows)); };
  const int threads = rows() < rows_worth_sharing ? 1 : threads_in_use();
  if (threads == 1) {
    for (const Part& part : parts_) take(part);
    return;
  }
  run_phases(std::array<int, 1>{threads * tasks_a_thread}, 1, [&](int, int task) {
    for (const Part& part : parts_of_task(task, threads)) take(part);
  });
}

}  // namespace scree::thermal
