// A Cholesky factor by supernodes: its pattern, and how its values are reached.
#pragma once

#include <algorithm>
#include <vector>

#include "thermal/supernode_kernels.h"

namespace scree::thermal {

// As CHOLMOD keeps it (cholmod_core.h): supernode s has the columns first[s] to first[s + 1] and the rows from rows_begin[s] on
// to rows_begin[s + 1], which begin with those of its columns and ascend; its values, column by column, start at
// values_begin[s], and all end at values_begin[supernodes]. Row and column i stand for unknown permutation[i].
struct SupernodalPattern {
  int unknowns = 0;
  int supernodes = 0;
  const int* first = nullptr;
  const int* rows_begin = nullptr;
  const int* rows = nullptr;
  const int* values_begin = nullptr;
  const int* permutation = nullptr;

  [[nodiscard]] int rows_of(int s) const { return rows_begin[s + 1] - rows_begin[s]; }
  [[nodiscard]] int columns_of(int s) const { return first[s + 1] - first[s]; }
  [[nodiscard]] int row(int s, int i) const { return rows[rows_begin[s] + i]; }
  // Which supernode each column is in.
  [[nodiscard]] std::vector<int> holders() const {
    std::vector<int> holders(unknowns);
    for (int s = 0; s < supernodes; ++s) std::fill(holders.begin() + first[s], holders.begin() + first[s + 1], s);
    return holders;
  }
  template <class Value>
  [[nodiscard]] Supernode<Value> supernode(const Value* values, int s) const {
    return {values + values_begin[s], rows_of(s), columns_of(s)};
  }

  // Values of rows stand in x[sides * row + side], in w as the kernels want them.
  // The first `count` rows of supernode s from x; the others are zero.
  template <int sides>
  void load(int s, int count, const double* x, double* w) const {
    for (int c = 0; c < sides; ++c) {
      double* side = w + c * rows_of(s);
      for (int i = 0; i < count; ++i) side[i] = x[sides * row(s, i) + c];
      std::fill(side + count, side + rows_of(s), 0.0);
    }
  }
  // Into x: those of the columns take the place of what is there, those after them, to before `count`, are added to it.
  template <int sides>
  void store(int s, int count, const double* w, double* x) const {
    const int columns = columns_of(s);
    for (int c = 0; c < sides; ++c) {
      const double* side = w + c * rows_of(s);
      for (int i = 0; i < columns; ++i) x[sides * row(s, i) + c] = side[i];
      for (int i = columns; i < count; ++i) x[sides * row(s, i) + c] += side[i];
    }
  }
};

}  // namespace scree::thermal
