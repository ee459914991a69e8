#include "thermal/supernode_kernels.h"

#include "thermal/wide.h"

namespace scree::thermal {

namespace {

// Columns that are gone through together.
constexpr int panel_columns = 4;

template <class Value>
SCREE_INLINE const Value* column_of(const Supernode<Value>& node, int column) {
  return node.values + static_cast<std::ptrdiff_t>(column) * node.rows;
}

// The same row of a column some way off, which is gone through next. Columns are too short for the processor to foresee them.
template <class Value>
SCREE_INLINE void fetch_ahead(const Value* value, int rows, int columns) {
  __builtin_prefetch(value + static_cast<std::ptrdiff_t>(columns) * rows);
}

// w[i] -= sum_q values[i + q rows] y[q].
template <int panel, int sides, class Value>
SCREE_INLINE void subtract_panel(const Supernode<Value>& node, int column, Span rows, const double (&y)[sides][panel],
                                 double* w) {
  const Value* values = column_of(node, column);
  int i = rows.begin;
  for (; i + numbers_in_quad <= rows.end; i += numbers_in_quad) {
    Quad sum[sides];
    for (int c = 0; c < sides; ++c) load(sum[c], w + c * node.rows + i);
    for (int q = 0; q < panel; ++q) {
      Quad value;
      load(value, values + q * node.rows + i);
      fetch_ahead(values + q * node.rows + i, node.rows, panel);
      for (int c = 0; c < sides; ++c) sum[c] -= value * y[c][q];
    }
    for (int c = 0; c < sides; ++c) store(sum[c], w + c * node.rows + i);
  }
  for (; i < rows.end; ++i) {
    for (int c = 0; c < sides; ++c) {
      for (int q = 0; q < panel; ++q) w[c * node.rows + i] -= values[q * node.rows + i] * y[c][q];
    }
  }
}

// sums[q] = sum_i values[i + q rows] w[i].
template <int panel, int sides, class Value>
SCREE_INLINE void multiply_panel(const Supernode<Value>& node, int column, Span rows, const double* w,
                                 double (&sums)[sides][panel]) {
  const Value* values = column_of(node, column);
  Quad lanes[sides][panel] = {};
  int i = rows.begin;
  for (; i + numbers_in_quad <= rows.end; i += numbers_in_quad) {
    Quad factor[sides];
    for (int c = 0; c < sides; ++c) load(factor[c], w + c * node.rows + i);
    for (int q = 0; q < panel; ++q) {
      Quad value;
      load(value, values + q * node.rows + i);
      fetch_ahead(values + q * node.rows + i, node.rows, -panel);
      for (int c = 0; c < sides; ++c) lanes[c][q] += value * factor[c];
    }
  }
  for (int c = 0; c < sides; ++c) {
    for (int q = 0; q < panel; ++q) {
      double sum = (lanes[c][q][0] + lanes[c][q][1]) + (lanes[c][q][2] + lanes[c][q][3]);
      for (int k = i; k < rows.end; ++k) sum += values[q * node.rows + k] * w[c * node.rows + k];
      sums[c][q] = sum;
    }
  }
}

template <int panel, int sides, class Value>
SCREE_INLINE void forward_panel(const Supernode<Value>& node, int column, int last, double* w) {
  const Value* values = column_of(node, column);
  double y[sides][panel];
  for (int c = 0; c < sides; ++c) {
    for (int q = 0; q < panel; ++q) {
      double left = w[c * node.rows + column + q];
      for (int p = 0; p < q; ++p) left -= values[p * node.rows + column + q] * y[c][p];
      w[c * node.rows + column + q] = y[c][q] = left / values[q * node.rows + column + q];
    }
  }
  subtract_panel<panel, sides>(node, column, {column + panel, last}, y, w);
}

template <int panel, int sides, class Value>
SCREE_INLINE void backward_panel(const Supernode<Value>& node, int column, int last, double* w) {
  const Value* values = column_of(node, column);
  double sums[sides][panel];
  multiply_panel<panel, sides>(node, column, {column + panel, last}, w, sums);
  for (int c = 0; c < sides; ++c) {
    for (int q = panel - 1; q >= 0; --q) {
      double left = w[c * node.rows + column + q] - sums[c][q];
      for (int p = q + 1; p < panel; ++p) left -= values[q * node.rows + column + p] * w[c * node.rows + column + p];
      w[c * node.rows + column + q] = left / values[q * node.rows + column + q];
    }
  }
}

template <int panel, int sides, class Value>
SCREE_INLINE void subtract_from(const Supernode<Value>& node, int column, Span rows, double* w) {
  double y[sides][panel];
  for (int c = 0; c < sides; ++c) {
    for (int q = 0; q < panel; ++q) y[c][q] = w[c * node.rows + column + q];
  }
  subtract_panel<panel, sides>(node, column, rows, y, w);
}

template <int panel, int sides, class Value>
SCREE_INLINE void multiply_into(const Supernode<Value>& node, int column, Span rows, const double* w, int stride,
                                double* sums) {
  double of_panel[sides][panel];
  multiply_panel<panel, sides>(node, column, rows, w, of_panel);
  for (int c = 0; c < sides; ++c) {
    for (int q = 0; q < panel; ++q) sums[c * stride + q] = of_panel[c][q];
  }
}

template <int sides, class Value>
SCREE_INLINE void forward_in(const Supernode<Value>& node, Span columns, int last, double* w) {
  int column = columns.begin;
  for (; column + panel_columns <= columns.end; column += panel_columns)
    forward_panel<panel_columns, sides>(node, column, last, w);
  for (; column < columns.end; ++column) forward_panel<1, sides>(node, column, last, w);
}

template <int sides, class Value>
SCREE_INLINE void backward_in(const Supernode<Value>& node, Span columns, int last, double* w) {
  int column = columns.end;
  for (; column % panel_columns != 0; --column) backward_panel<1, sides>(node, column - 1, last, w);
  for (; column > columns.begin; column -= panel_columns) {
    backward_panel<panel_columns, sides>(node, column - panel_columns, last, w);
  }
}

template <int sides, class Value>
SCREE_INLINE void subtract_in(const Supernode<Value>& node, Span columns, Span rows, double* w) {
  int column = columns.begin;
  for (; column + panel_columns <= columns.end; column += panel_columns)
    subtract_from<panel_columns, sides>(node, column, rows, w);
  for (; column < columns.end; ++column) subtract_from<1, sides>(node, column, rows, w);
}

template <int sides, class Value>
SCREE_INLINE void multiply_in(const Supernode<Value>& node, Span columns, Span rows, const double* w, double* sums) {
  const int stride = columns.end - columns.begin;
  int column = columns.begin;
  for (; column + panel_columns <= columns.end; column += panel_columns) {
    multiply_into<panel_columns, sides>(node, column, rows, w, stride, sums + (column - columns.begin));
  }
  for (; column < columns.end; ++column)
    multiply_into<1, sides>(node, column, rows, w, stride, sums + (column - columns.begin));
}

}  // namespace

template <>
SCREE_WIDE void forward<1>(const Supernode<double>& node, Span columns, int last, double* w) {
  forward_in<1>(node, columns, last, w);
}
template <>
SCREE_WIDE void forward<2>(const Supernode<double>& node, Span columns, int last, double* w) {
  forward_in<2>(node, columns, last, w);
}
template <>
SCREE_WIDE void forward<1>(const Supernode<float>& node, Span columns, int last, double* w) {
  forward_in<1>(node, columns, last, w);
}
template <>
SCREE_WIDE void forward<2>(const Supernode<float>& node, Span columns, int last, double* w) {
  forward_in<2>(node, columns, last, w);
}
template <>
SCREE_WIDE void backward<1>(const Supernode<double>& node, Span columns, int last, double* w) {
  backward_in<1>(node, columns, last, w);
}
template <>
SCREE_WIDE void backward<2>(const Supernode<double>& node, Span columns, int last, double* w) {
  backward_in<2>(node, columns, last, w);
}
template <>
SCREE_WIDE void backward<1>(const Supernode<float>& node, Span columns, int last, double* w) {
  backward_in<1>(node, columns, last, w);
}
template <>
SCREE_WIDE void backward<2>(const Supernode<float>& node, Span columns, int last, double* w) {
  backward_in<2>(node, columns, last, w);
}
template <>
SCREE_WIDE void subtract<1>(const Supernode<double>& node, Span columns, Span rows, double* w) {
  subtract_in<1>(node, columns, rows, w);
}
template <>
SCREE_WIDE void subtract<2>(const Supernode<double>& node, Span columns, Span rows, double* w) {
  subtract_in<2>(node, columns, rows, w);
}
template <>
SCREE_WIDE void subtract<1>(const Supernode<float>& node, Span columns, Span rows, double* w) {
  subtract_in<1>(node, columns, rows, w);
}
template <>
SCREE_WIDE void subtract<2>(const Supernode<float>& node, Span columns, Span rows, double* w) {
  subtract_in<2>(node, columns, rows, w);
}
template <>
SCREE_WIDE void multiply<1>(const Supernode<double>& node, Span columns, Span rows, const double* w, double* sums) {
  multiply_in<1>(node, columns, rows, w, sums);
}
template <>
SCREE_WIDE void multiply<2>(const Supernode<double>& node, Span columns, Span rows, const double* w, double* sums) {
  multiply_in<2>(node, columns, rows, w, sums);
}
template <>
SCREE_WIDE void multiply<1>(const Supernode<float>& node, Span columns, Span rows, const double* w, double* sums) {
  multiply_in<1>(node, columns, rows, w, sums);
}
template <>
SCREE_WIDE void multiply<2>(const Supernode<float>& node, Span columns, Span rows, const double* w, double* sums) {
  multiply_in<2>(node, columns, rows, w, sums);
}

}  // namespace scree::thermal
