#include "thermal/row_bundles.h"

#include <algorithm>
#include <array>

#include "thermal/wide.h"

namespace scree::thermal {

namespace {

constexpr int lanes = rows_in_bundle;
static_assert(lanes == numbers_in_quad);

// What is that far ahead of a column is asked for: K of a pile is larger than the nearer caches.
SCREE_INLINE void fetch_ahead(const double* values) {
  constexpr int ahead = 64 * lanes;
  __builtin_prefetch(values + ahead);
}

// One column of x: a lane for each row.
SCREE_INLINE void bundle_of_single(const Bundle& bundle, const int* column, const double* value, const double* x,
                                   const double* here, double* flow) {
  Quad from, values, sum{};
  load(from, here);
  for (int k = bundle.begin; k < bundle.begin + bundle.columns; ++k) {
    const double there = x[column[k]];
    fetch_ahead(value + lanes * static_cast<std::ptrdiff_t>(k));
    load(values, value + lanes * static_cast<std::ptrdiff_t>(k));
    sum += values * (Quad{there, there, there, there} - from);
  }
  store(sum, flow);
}

// Two columns of x: two rows to a Quad.
SCREE_INLINE void bundle_of_twin(const Bundle& bundle, const int* column, const double* value, const double* x,
                                 const double* here, double* flow) {
  Quad from[2], values, sum[2] = {};
  load(from[0], here);
  load(from[1], here + lanes);
  for (int k = bundle.begin; k < bundle.begin + bundle.columns; ++k) {
    const double* at = x + 2 * static_cast<std::ptrdiff_t>(column[k]);
    const Quad there{at[0], at[1], at[0], at[1]};
    fetch_ahead(value + lanes * static_cast<std::ptrdiff_t>(k));
    load(values, value + lanes * static_cast<std::ptrdiff_t>(k));
    sum[0] += __builtin_shufflevector(values, values, 0, 0, 1, 1) * (there - from[0]);
    sum[1] += __builtin_shufflevector(values, values, 2, 2, 3, 3) * (there - from[1]);
  }
  store(sum[0], flow);
  store(sum[1], flow + lanes);
}

template <int width>
SCREE_INLINE void flows_of(std::span<const Bundle> bundles, const int* column, const double* value, const double* x,
                           double* flow) {
  for (const Bundle& bundle : bundles) {
    const double* here = x + width * static_cast<std::ptrdiff_t>(bundle.first);
    const auto kernel = width == 1 ? bundle_of_single : bundle_of_twin;
    kernel(bundle, column, value, x, here, flow);
    flow += width * lanes;
  }
}

// A column of a bundle takes as long as two entries of a row by itself, and from memory as long as three.
constexpr bool pays(std::ptrdiff_t columns, std::ptrdiff_t entries) {
  return 8 * columns <= 3 * entries;
}

// Whether the first of four rows has entries at all of them: else they are not of one small block, and nothing more need be
// asked.
bool meet(const Eigen::SparseMatrix<double>& matrix, int first) {
  const int* begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[first];
  const int* end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[first + 1];
  const int* own = std::lower_bound(begin, end, first);
  return end - own >= lanes && own[0] == first && own[lanes - 1] == first + lanes - 1;
}

// The columns that any of four rows has, ascending.
std::vector<int> columns_of(const Eigen::SparseMatrix<double>& matrix, int first) {
  const int* outer = matrix.outerIndexPtr();
  std::vector<int> columns(matrix.innerIndexPtr() + outer[first], matrix.innerIndexPtr() + outer[first + lanes]);
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

}  // namespace

bool RowBundles::add(const Eigen::SparseMatrix<double>& matrix, int row) {
  const int* outer = matrix.outerIndexPtr();
  if (row + lanes > matrix.rows() || !meet(matrix, row)) return false;
  const std::vector<int> columns = columns_of(matrix, row);
  if (!pays(std::ssize(columns), outer[row + lanes] - outer[row])) return false;
  bundles_.push_back({row, static_cast<int>(columns_.size()), static_cast<int>(columns.size())});
  columns_.insert(columns_.end(), columns.begin(), columns.end());
  const std::size_t begin = values_.size();
  values_.resize(begin + lanes * columns.size(), 0.0);
  for (int i = 0; i < lanes; ++i) {
    auto place = columns.begin();
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, row + i); entry; ++entry) {
      place = std::lower_bound(place, columns.end(), static_cast<int>(entry.row()));
      values_[begin + lanes * (place - columns.begin()) + i] = entry.value();
    }
  }
  return true;
}

template <>
SCREE_WIDE void RowBundles::flows<1>(std::size_t begin, std::size_t end, const double* x, double* flow) const {
  flows_of<1>(std::span(bundles_).subspan(begin, end - begin), columns_.data(), values_.data(), x, flow);
}

template <>
SCREE_WIDE void RowBundles::flows<2>(std::size_t begin, std::size_t end, const double* x, double* flow) const {
  flows_of<2>(std::span(bundles_).subspan(begin, end - begin), columns_.data(), values_.data(), x, flow);
}

}  // namespace scree::thermal
