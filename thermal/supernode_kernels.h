// The two halves of a solve within one supernode, whose values stand column by column. Four columns are gone through at once,
// and every value is read once for all right sides, which stand behind each other in `w`, one number for each row.
#pragma once

#include "thermal/wide.h"

namespace scree::thermal {

struct Supernode {
  const double* values;  // column by column
  int rows;
  int columns;  // the first rows are theirs, and of what is above the diagonal nothing is read
};

// Four neighbouring rows. In lanes, so that sums round the same however wide the processor's instructions are.
using FourRows = double __attribute__((vector_size(4 * sizeof(double))));
inline constexpr int rows_at_once = 4;

SCREE_INLINE void load(const double* from, FourRows& rows) {
  __builtin_memcpy(&rows, from, sizeof(rows));
}

// w[i] -= sum_q values[i + q rows] y[q] for rows from `begin` on.
template <int panel, int sides>
SCREE_INLINE void subtract(const Supernode& node, int begin, const double* values, const double (&y)[sides][panel], double* w) {
  int i = begin;
  for (; i + rows_at_once <= node.rows; i += rows_at_once) {
    FourRows sum[sides];
    for (int c = 0; c < sides; ++c) load(w + c * node.rows + i, sum[c]);
    for (int q = 0; q < panel; ++q) {
      FourRows value;
      load(values + q * node.rows + i, value);
      for (int c = 0; c < sides; ++c) sum[c] -= value * y[c][q];
    }
    for (int c = 0; c < sides; ++c) __builtin_memcpy(w + c * node.rows + i, &sum[c], sizeof(sum[c]));
  }
  for (; i < node.rows; ++i) {
    for (int c = 0; c < sides; ++c) {
      for (int q = 0; q < panel; ++q) w[c * node.rows + i] -= values[q * node.rows + i] * y[c][q];
    }
  }
}

// sums[c][q] = sum_i values[i + q rows] w[i] over rows from `begin` on.
template <int panel, int sides>
SCREE_INLINE void multiply(const Supernode& node, int begin, const double* values, const double* w,
                           double (&sums)[sides][panel]) {
  FourRows lanes[sides][panel] = {};
  int i = begin;
  for (; i + rows_at_once <= node.rows; i += rows_at_once) {
    FourRows factor[sides];
    for (int c = 0; c < sides; ++c) load(w + c * node.rows + i, factor[c]);
    for (int q = 0; q < panel; ++q) {
      FourRows value;
      load(values + q * node.rows + i, value);
      for (int c = 0; c < sides; ++c) lanes[c][q] += value * factor[c];
    }
  }
  for (int c = 0; c < sides; ++c) {
    for (int q = 0; q < panel; ++q) {
      double sum = (lanes[c][q][0] + lanes[c][q][1]) + (lanes[c][q][2] + lanes[c][q][3]);
      for (int k = i; k < node.rows; ++k) sum += values[q * node.rows + k] * w[c * node.rows + k];
      sums[c][q] = sum;
    }
  }
}

template <int panel, int sides>
SCREE_INLINE void forward_panel(const Supernode& node, int column, double* w) {
  const double* values = node.values + static_cast<std::ptrdiff_t>(column) * node.rows;
  double y[sides][panel];
  for (int c = 0; c < sides; ++c) {
    for (int q = 0; q < panel; ++q) {
      double left = w[c * node.rows + column + q];
      for (int p = 0; p < q; ++p) left -= values[p * node.rows + column + q] * y[c][p];
      w[c * node.rows + column + q] = y[c][q] = left / values[q * node.rows + column + q];
    }
  }
  subtract<panel, sides>(node, column + panel, values, y, w);
}

template <int panel, int sides>
SCREE_INLINE void backward_panel(const Supernode& node, int column, double* w) {
  const double* values = node.values + static_cast<std::ptrdiff_t>(column) * node.rows;
  double sums[sides][panel];
  multiply<panel, sides>(node, column + panel, values, w, sums);
  for (int c = 0; c < sides; ++c) {
    for (int q = panel - 1; q >= 0; --q) {
      double left = w[c * node.rows + column + q] - sums[c][q];
      for (int p = q + 1; p < panel; ++p) left -= values[q * node.rows + column + p] * w[c * node.rows + column + p];
      w[c * node.rows + column + q] = left / values[q * node.rows + column + q];
    }
  }
}

// From what is asked of the columns' rows to their part of L^-1 b; what that takes from the other rows is added to theirs.
template <int sides>
SCREE_INLINE void forward_in(const Supernode& node, double* w) {
  int column = 0;
  for (; column + 4 <= node.columns; column += 4) forward_panel<4, sides>(node, column, w);
  for (; column < node.columns; ++column) forward_panel<1, sides>(node, column, w);
}

// From that, and the solution in the other rows, to the solution in those of the columns.
template <int sides>
SCREE_INLINE void backward_in(const Supernode& node, double* w) {
  int column = node.columns;
  for (; column % 4 != 0; --column) backward_panel<1, sides>(node, column - 1, w);
  for (; column > 0; column -= 4) backward_panel<4, sides>(node, column - 4, w);
}

}  // namespace scree::thermal
