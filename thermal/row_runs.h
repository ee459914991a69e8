// Rows of K that repeat. In a grid of equal cells most rows are the one before, moved along by one node: the same values at
// columns that are each one further. Such rows are multiplied together, several nodes to an instruction, and their values are
// read once: in a grid a product then costs a fifth of what reading K for each row does. Elsewhere a run is one row long.
//
// The flows of a row are summed in the order of its columns whatever the run, so how rows are grouped, and how wide the
// processor's instructions are, does not change a bit.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "engine/base/threads.h"

namespace scree::thermal {

struct RowRun {
  int first;    // row
  int rows;     // at least one
  int begin;    // of its entries in K, those of the first row
  int entries;  // of a row
};

class RowRuns {
 public:
  RowRuns() = default;
  // Refers to the matrix, which is symmetric to the bit: its columns are its rows.
  explicit RowRuns(const Eigen::SparseMatrix<double>& matrix);

  // Calls use(row, flow) for every row i, in no order of note and on all threads: flow[c] is the sum over j of K_ij (x_jc -
  // x_ic), for `columns` columns of x that lie side by side.
  template <int columns, class Use>
  void for_each_flow(const double* x, const Use& use) const;

  [[nodiscard]] std::size_t count() const { return runs_.size(); }

 private:
  // Runs whose rows are worked off together.
  struct Part {
    std::size_t begin, end;  // runs
  };
  static constexpr int rows_in_part = 512;
  static constexpr int rows_in_run = 128;

  // The flows of a part's rows, one after another.
  template <int columns>
  void flows(const Part& part, const double* x, double* flow) const;

  const int* column_ = nullptr;
  const double* value_ = nullptr;
  std::vector<RowRun> runs_;
  std::vector<Part> parts_;
};

template <>
void RowRuns::flows<1>(const Part& part, const double* x, double* flow) const;
template <>
void RowRuns::flows<2>(const Part& part, const double* x, double* flow) const;

template <int columns, class Use>
void RowRuns::for_each_flow(const double* x, const Use& use) const {
  const auto count = static_cast<std::int64_t>(parts_.size());
#pragma omp parallel for schedule(static) if (count * rows_in_part >= rows_worth_sharing)
  for (std::int64_t p = 0; p < count; ++p) {
    double flow[columns * (rows_in_part + rows_in_run)];
    const Part& part = parts_[static_cast<std::size_t>(p)];
    flows<columns>(part, x, flow);
    const int first = runs_[part.begin].first;
    const int last = runs_[part.end - 1].first + runs_[part.end - 1].rows;
    for (int row = first; row < last; ++row) use(row, flow + columns * (row - first));
  }
}

}  // namespace scree::thermal
