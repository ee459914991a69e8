// Four rows of K with nearly the same columns, one after another: those of the nodes of a block that is one tetrahedron, which
// all meet the same neighbours. They are multiplied together: each column is fetched once for all of them, and their values,
// side by side, are worked on in one instruction. Where a row has no entry its value is 0, which changes no bit of its sum.
#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCore>

namespace scree::thermal {

inline constexpr int rows_in_bundle = 4;

struct Bundle {
  int first;    // row
  int begin;    // of its columns among those of all bundles
  int columns;  // that any of its rows has
};

class RowBundles {
 public:
  // Appends the bundle that begins at `row` if that makes products faster; returns whether it did.
  bool add(const Eigen::SparseMatrix<double>& matrix, int row);

  [[nodiscard]] const Bundle& operator[](std::size_t i) const { return bundles_[i]; }
  [[nodiscard]] std::size_t count() const { return bundles_.size(); }

  // The flows of the rows of bundles `begin` to `end`, as RowRuns has them, one after another.
  template <int width>
  void flows(std::size_t begin, std::size_t end, const double* x, double* flow) const;

 private:
  std::vector<Bundle> bundles_;
  std::vector<int> columns_;
  std::vector<double> values_;  // one of each row for every column
};

template <>
void RowBundles::flows<1>(std::size_t begin, std::size_t end, const double* x, double* flow) const;
template <>
void RowBundles::flows<2>(std::size_t begin, std::size_t end, const double* x, double* flow) const;

}  // namespace scree::thermal
