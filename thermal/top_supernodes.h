// The supernodes in which all trees of a factor meet. There are few, one above the other, and large: each is gone through block
// of columns by block. The block's own corner is solved by one thread, the rows after it by all, some at a time.
#pragma once

#include <vector>

#include "thermal/supernodal_pattern.h"

namespace scree::thermal {

class TopSupernodes {
 public:
  // Refers to the pattern's arrays. Supernodes ascend.
  void set(const SupernodalPattern& pattern, const std::vector<int>& supernodes);

  // The tasks of each phase (engine/base/phases.h) of a solve.
  [[nodiscard]] const std::vector<int>& sizes() const { return sizes_; }

  // What the phases of one solve hand on.
  struct Space {
    std::vector<double> w, sums;
  };
  template <int sides>
  [[nodiscard]] Space space() const;

  // x[sides * row + side] of all rows: the right sides, less what the trees below take, become the solution. `values`: the
  // factor's.
  template <int sides, class Value>
  void run(int phase, int task, const Value* values, double* x, Space& space) const;

 private:
  struct Block {
    int supernode;
    Span columns;
    int pieces;  // of the rows after it; 0: too few to share
  };
  [[nodiscard]] Span rows_of(const Block& block, int piece) const;
  template <int sides, class Value>
  void forward_corner(std::size_t number, const Value* values, double* x, double* w) const;
  template <int sides, class Value>
  void backward_corner(std::size_t number, const Value* values, double* x, Space& space) const;

  SupernodalPattern pattern_;
  std::vector<Block> blocks_;
  std::vector<int> sizes_;
  int most_rows_ = 0;
  int most_pieces_ = 0;
};

}  // namespace scree::thermal
