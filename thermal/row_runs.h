// Rows of K that repeat. In a grid of equal cells most rows are the one before, moved along by one node: the same values at
// columns that are each one further. Such rows are multiplied together, several nodes to an instruction, and their values are
// read once: in a grid a product then costs a fifth of what reading K for each row does. Elsewhere a run is one row long, but
// the rows of small blocks are bundled (row_bundles.h).
//
// The flows of a row are summed in the order of its columns whatever the run, so how rows are grouped, and how wide the
// processor's instructions are, does not change a bit.
#pragma once

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

class RowRuns {
 public:
  // Refers to the matrix, which is symmetric to the bit: its columns are its rows.
  explicit RowRuns(const Eigen::SparseMatrix<double>& matrix);

  // Calls use(row, flow) for every row i, in no order of note and on all threads: flow[c] is the sum over j of K_ij (x_jc -
  // x_ic), for `columns` columns of x that lie side by side.
  template <int columns, class Use>
  void for_each_flow(const double* x, const Use& use) const;

  [[nodiscard]] std::size_t count() const { return runs_.size(); }
  [[nodiscard]] std::size_t bundles() const { return bundles_.count(); }

 private:
  // Consecutive rows that are worked off together, each part about as long as another.
  struct Part {
    int first, rows;
    bool bundled;            // in bundles, else in runs
    std::size_t begin, end;  // of those
    std::int64_t work;       // entries that are read
  };
  static constexpr int rows_in_part = 512;
  static constexpr int rows_in_run = 128;
  static constexpr std::int64_t work_in_part = 8192;
  static constexpr int tasks_a_thread = 5;

  [[nodiscard]] long rows() const { return parts_.empty() ? 0 : parts_.back().first + parts_.back().rows; }
  void append(int row, int rows, bool bundled, std::int64_t work);

  // Each thread has a share of the rows. The first tasks are three quarters of every share, for a thread that takes the same
  // one in every product finds it in its cache; the others are small and even out who is done first.
  [[nodiscard]] std::span<const Part> parts_of_task(int task, int threads) const;

  // The flows of a part's rows, one after another.
  template <int columns>
  void flows(const Part& part, const double* x, double* flow) const;

  const int* column_;
  const double* value_;
  std::vector<RowRun> runs_;
  RowBundles bundles_;
  std::vector<Part> parts_;
};

template <>
void RowRuns::flows<1>(const Part& part, const double* x, double* flow) const;
template <>
void RowRuns::flows<2>(const Part& part, const double* x, double* flow) const;

template <int columns, class Use>
void RowRuns::for_each_flow(const double* x, const Use& use) const {
  const auto work_off = [&](const Part& part) {
    double flow[columns * (rows_in_part + rows_in_run)];
    if (part.bundled) {
      bundles_.flows<columns>(part.begin, part.end, x, flow);
    } else {
      flows<columns>(part, x, flow);
    }
    for (int i = 0; i < part.rows; ++i) use(part.first + i, flow + columns * i);
  };
  if (rows() < rows_worth_sharing) {
    for (const Part& part : parts_) work_off(part);
    return;
  }
  const int threads = threads_in_use();
  run_phases(std::array<int, 1>{threads * tasks_a_thread}, 1, [&](int, int task) {
    for (const Part& part : parts_of_task(task, threads)) work_off(part);
  });
}

}  // namespace scree::thermal
