// Solves L L^T x = b with a supernodal Cholesky factor on all threads, of which the pattern alone is kept here: the values, in
// double or in single precision, come with the right sides. CHOLMOD's own solve goes through L twice on one of them,
// and in runs of hundreds of steps with a dozen matrices that is where the time goes.
//
// A supernode is a run of columns of L with the same rows. Trees of their forest (supernode_forest.h) are solved at once, and
// what they give to the rows above is added in their order. How the forest is cut depends on the pattern alone, so any number
// of threads gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "thermal/supernode_forest.h"
#include "thermal/top_supernodes.h"

namespace scree::thermal {

class SupernodalSolve {
 public:
  // Refers to the pattern's arrays.
  explicit SupernodalSolve(const SupernodalPattern& pattern);

  // Each column of `rhs` to its solution.
  template <class Value>
  [[nodiscard]] Eigen::MatrixXd solve(const Value* values, const Eigen::MatrixXd& rhs) const;

  // Of the factor.
  [[nodiscard]] std::size_t entries() const { return static_cast<std::size_t>(pattern_.values_begin[pattern_.supernodes]); }

 private:
  using Tree = CutForest::Tree;
  void find_rows_above(const std::vector<int>& top);
  template <int sides, class Value>
  void solve(const Value* values, const double* rhs, double* solution) const;
  template <int sides, class Value>
  void forward(const Tree& tree, const Value* values, double* x, double* above) const;
  template <int sides, class Value>
  void backward(const Tree& tree, const Value* values, double* x) const;

  SupernodalPattern pattern_;
  std::vector<Tree> trees_;      // solved at once
  TopSupernodes top_;            // what is above them
  std::vector<int> rows_below_;  // of each supernode, how many of its rows are not in the top
  std::vector<int> top_rows_;    // the rows of the top
  std::vector<int> top_place_;   // of each row, where it is among them
  std::vector<int> sizes_;       // tasks of each phase
  std::size_t most_rows_ = 0;    // of a supernode
};

}  // namespace scree::thermal
