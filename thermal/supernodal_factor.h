// Factorises symmetric matrices of one pattern as L L^T, by supernodes and on all threads.
//
// Each supernode's columns are gathered from those that it depends on ("left-looking", as in CHOLMOD, Chen, Davis, Hager &
// Rajamanickam 2008), trees of supernodes at once (supernode_forest.h). What is above the trees is gone through block of
// columns by block, some rows of it at a time. What is summed by whom depends on the pattern alone, so any number of threads
// gives the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "thermal/dense_kernels.h"
#include "thermal/incidence.h"
#include "thermal/supernodal_pattern.h"
#include "thermal/supernode_forest.h"

namespace scree::thermal {

class SupernodalFactor {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  // Refers to the pattern's arrays. Of the matrices the lower triangle is given.
  SupernodalFactor(const SupernodalPattern& pattern, const Matrix& lower, const DenseKernels& kernels);

  // Into the values of L, all of which are written. False if the matrix is not positive definite; they are of no use then.
  [[nodiscard]] bool factorise(const Matrix& lower, double* values) const;

 private:
  // That supernode's rows from `begin` to before `end` are columns of another, which it changes.
  struct Update {
    int source;
    int begin;
    int end;
  };
  // A value of the matrix and its place among those of L.
  struct Entry {
    int place;
    int number;
  };
  // Columns of a supernode.
  struct Block {
    int supernode;
    Span columns;
    int rows_in_piece;  // of those below them
  };
  // Columns of L, by supernode or block, that change those of a block: their rows from `begin` to before `end`.
  struct Source {
    const double* values;
    int columns;
    std::span<const int> rows;
    int begin;
    int end;
  };
  // What a task works with.
  struct Space {
    std::vector<int> place;        // where each row of the matrix is in the block that is changed, if it is
    std::vector<int> places;       // the same, one behind the other
    std::vector<double> products;  // of a source
  };
  class Work;

  // `holder`: which supernode each column is in.
  SupernodalFactor(const SupernodalPattern& pattern, const Matrix& lower, const DenseKernels& kernels,
                   const std::vector<int>& holder);
  [[nodiscard]] PiecesOfRows<Update> find_updates(const std::vector<int>& holder) const;
  [[nodiscard]] PiecesOfRows<Entry> find_entries(const std::vector<int>& holder, const Matrix& lower) const;
  void cut();
  [[nodiscard]] std::vector<std::int64_t> flops() const;

  void run(int phase, int task, Work& work) const;
  void factorise_tree(const CutForest::Tree& tree, Work& work, Space& space) const;
  void assemble(int s, const double* matrix, double* values) const;
  template <class Visit>
  void for_each_source(const Block& block, const double* values, const Visit& visit) const;
  void gather_corner(const Block& block, double* values, Space& space) const;
  void gather_rows(const Block& block, Span rows, double* values, Space& space) const;
  [[nodiscard]] bool factorise_corner(const Block& block, double* values) const;
  void divide_rows(const Block& block, Span rows, double* values) const;
  [[nodiscard]] Span rows_of_piece(const Block& block, int piece) const;

  SupernodalPattern pattern_;
  DenseKernels kernels_;
  PiecesOfRows<Update> updates_;  // of each supernode, by ascending source
  PiecesOfRows<Entry> entries_;   // of each supernode
  Eigen::Index matrix_size_;      // entries of a matrix
  CutForest forest_;
  std::vector<Block> blocks_;  // of what is above the trees
  std::vector<int> sizes_;     // tasks of each phase
};

}  // namespace scree::thermal
