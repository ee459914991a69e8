// The supernodes in which all trees of a factor meet. There are few, one above the other, and large: each is gone through block
// of columns by block. The block's own corner is solved by one thread, the rows after it by all, some at a time.
#pragma once

#include <vector>

#include "thermal/supernode_kernels.h"

namespace scree::thermal {

// As CHOLMOD keeps it (cholmod_core.h): supernode s has the columns first[s] to first[s + 1] and the rows from rows_begin[s] on
// to rows_begin[s + 1], which begin with those of its columns and ascend; its values, column by column, start at
// values_begin[s]. Row and column i stand for unknown permutation[i].
struct SupernodalFactor {
  int unknowns = 0;
  int supernodes = 0;
  const int* first = nullptr;
  const int* rows_begin = nullptr;
  const int* rows = nullptr;
  const int* values_begin = nullptr;
  const double* values = nullptr;
  const int* permutation = nullptr;

  [[nodiscard]] int rows_of(int s) const { return rows_begin[s + 1] - rows_begin[s]; }
  [[nodiscard]] Supernode supernode(int s) const { return {values + values_begin[s], rows_of(s), first[s + 1] - first[s]}; }
};

class TopSupernodes {
 public:
  // Refers to the factor's arrays. Supernodes ascend.
  void set(const SupernodalFactor& factor, const std::vector<int>& supernodes);

  // The tasks of each phase (engine/base/phases.h) of a solve.
  [[nodiscard]] const std::vector<int>& sizes() const { return sizes_; }

  // What the phases of one solve hand on.
  struct Space {
    std::vector<double> w, sums;
  };
  template <int sides>
  [[nodiscard]] Space space() const;

  // x[sides * row + side] of all rows: the right sides, less what the trees below take, become the solution.
  template <int sides>
  void run(int phase, int task, double* x, Space& space) const;

 private:
  struct Block {
    int supernode;
    Span columns;
    int pieces;  // of the rows after it; 0: too few to share
  };
  [[nodiscard]] Span rows_of(const Block& block, int piece) const;
  template <int sides>
  void load(int supernode, bool below, const double* x, double* w) const;
  template <int sides>
  void store(int supernode, bool below, const double* w, double* x) const;
  template <int sides>
  void forward_corner(std::size_t number, double* x, double* w) const;
  template <int sides>
  void backward_corner(std::size_t number, double* x, Space& space) const;

  SupernodalFactor factor_;
  std::vector<Block> blocks_;
  std::vector<int> sizes_;
  int most_rows_ = 0;
  int most_pieces_ = 0;
};

}  // namespace scree::thermal
