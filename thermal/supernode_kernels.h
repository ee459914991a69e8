// The two halves of a solve within one supernode, whose values stand column by column, block of columns by block. The right
// sides stand behind each other in `w`, `sides` of them, one number for each row of the supernode, and every value is read once
// for all of them. Sums round the same for any number of sides, and however wide the processor's instructions are. Values may
// be in single precision, of which the memory gives twice as many in the same time; all else is in double precision.
#pragma once

#include <cstddef>

namespace scree::thermal {

template <class Value>
struct Supernode {
  const Value* values;  // column by column
  int rows;
  int columns;  // the first rows are theirs, and of what is above the diagonal nothing is read
};

// From `begin` to before `end`. Blocks of columns begin at multiples of 4.
struct Span {
  int begin, end;
};

// w of the columns becomes their part of L^-1 b, and what that takes from the rows after them, to before `last`, is taken.
template <int sides, class Value>
void forward(const Supernode<Value>& node, Span columns, int last, double* w);
// What the columns' part takes from the rows.
template <int sides, class Value>
void subtract(const Supernode<Value>& node, Span columns, Span rows, double* w);

// w of the columns becomes their part of the solution, from that in the rows after them, to before `last`.
template <int sides, class Value>
void backward(const Supernode<Value>& node, Span columns, int last, double* w);
// What the solution in the rows takes from the columns: sums[side * columns + column], counted from the first of them.
template <int sides, class Value>
void multiply(const Supernode<Value>& node, Span columns, Span rows, const double* w, double* sums);

}  // namespace scree::thermal
