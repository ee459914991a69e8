#include "thermal/supernodal_solve.h"

#include <algorithm>
#include <utility>

#include "engine/base/phases.h"
#include "engine/base/written_later.h"

namespace scree::thermal {

namespace {

// The forest is cut into trees that hold at most this part of the factor. What is above them is shared less well.
constexpr int parts = 5;
// Factors with fewer entries are done before a second thread has woken up.
constexpr std::int64_t entries_worth_sharing = 200'000;

std::vector<std::int64_t> entries_of(const SupernodalPattern& pattern) {
  std::vector<std::int64_t> entries(pattern.supernodes);
  for (int s = 0; s < pattern.supernodes; ++s) {
    entries[s] = static_cast<std::int64_t>(pattern.rows_of(s)) * pattern.columns_of(s);
  }
  return entries;
}

}  // namespace

SupernodalSolve::SupernodalSolve(const SupernodalPattern& pattern) : pattern_(pattern) {
  CutForest forest = cut_forest(pattern, entries_of(pattern), parts, entries_worth_sharing);
  trees_ = std::move(forest.trees);
  top_.set(pattern_, forest.top);
  // The right sides, up the trees, where they meet, the top, down the trees, the solution.
  const auto trees = static_cast<int>(trees_.size());
  const auto pieces = static_cast<int>(chunk_count(pattern.unknowns));
  sizes_ = {pieces, trees, 1};
  sizes_.insert(sizes_.end(), top_.sizes().begin(), top_.sizes().end());
  sizes_.insert(sizes_.end(), {trees, pieces});
  find_rows_above(forest.top);
}

void SupernodalSolve::find_rows_above(const std::vector<int>& top) {
  top_place_.assign(pattern_.unknowns, -1);
  for (const int s : top) {
    for (int row = pattern_.first[s]; row < pattern_.first[s + 1]; ++row) {
      top_place_[row] = static_cast<int>(top_rows_.size());
      top_rows_.push_back(row);
    }
  }
  rows_below_.resize(pattern_.supernodes);
  for (int s = 0; s < pattern_.supernodes; ++s) {
    const int* begin = pattern_.rows + pattern_.rows_begin[s];
    const int* end = pattern_.rows + pattern_.rows_begin[s + 1];
    most_rows_ = std::max(most_rows_, static_cast<std::size_t>(end - begin));
    rows_below_[s] = static_cast<int>(std::find_if(begin, end, [&](int row) { return top_place_[row] >= 0; }) - begin);
  }
}

template <int sides, class Value>
void SupernodalSolve::forward(const Tree& tree, const Value* values, double* x, double* above) const {
  std::vector<double> w(sides * most_rows_);
  for (const int s : tree.supernodes) {
    const Supernode<Value> node = pattern_.supernode(values, s);
    pattern_.load<sides>(s, node.columns, x, w.data());
    thermal::forward<sides>(node, {0, node.columns}, node.rows, w.data());
    pattern_.store<sides>(s, rows_below_[s], w.data(), x);
    for (int c = 0; c < sides; ++c) {
      for (int i = rows_below_[s]; i < node.rows; ++i)
        above[sides * top_place_[pattern_.row(s, i)] + c] += w[c * node.rows + i];
    }
  }
}

template <int sides, class Value>
void SupernodalSolve::backward(const Tree& tree, const Value* values, double* x) const {
  std::vector<double> w(sides * most_rows_);
  for (auto s = tree.supernodes.rbegin(); s != tree.supernodes.rend(); ++s) {
    const Supernode<Value> node = pattern_.supernode(values, *s);
    pattern_.load<sides>(*s, node.rows, x, w.data());
    thermal::backward<sides>(node, {0, node.columns}, node.rows, w.data());
    pattern_.store<sides>(*s, node.columns, w.data(), x);
  }
}

template <int sides, class Value>
void SupernodalSolve::solve(const Value* values, const double* rhs, double* solution) const {
  const int n = pattern_.unknowns;
  VectorWrittenLater<double> x(static_cast<std::size_t>(sides) * n);
  std::vector<std::vector<double>> above(trees_.size());
  TopSupernodes::Space space = top_.space<sides>();
  const auto for_piece = [n](int piece, const auto& visit) {
    const Chunk rows = chunk_of(n, piece);
    for (auto i = static_cast<int>(rows.begin); i < static_cast<int>(rows.end); ++i) visit(i);
  };
  const auto take = [&](int i) {
    for (int c = 0; c < sides; ++c) x[sides * i + c] = rhs[static_cast<std::ptrdiff_t>(c) * n + pattern_.permutation[i]];
  };
  const auto give = [&](int i) {
    for (int c = 0; c < sides; ++c) solution[static_cast<std::ptrdiff_t>(c) * n + pattern_.permutation[i]] = x[sides * i + c];
  };
  const auto meet = [&] {
    for (const auto& part : above) {
      for (std::size_t i = 0; i < top_rows_.size(); ++i) {
        for (int c = 0; c < sides; ++c) x[sides * top_rows_[i] + c] += part[sides * i + c];
      }
    }
  };
  const auto last = static_cast<int>(sizes_.size()) - 1;
  const auto work = [&](int phase, int task) {
    if (phase == 0) {
      for_piece(task, take);
    } else if (phase == 1) {
      above[task].assign(sides * top_rows_.size(), 0.0);
      forward<sides>(trees_[task], values, x.data(), above[task].data());
    } else if (phase == 2) {
      meet();
    } else if (phase + 1 < last) {
      top_.run<sides>(phase - 3, task, values, x.data(), space);
    } else if (phase < last) {
      backward<sides>(trees_[task], values, x.data());
    } else {
      for_piece(task, give);
    }
  };
  run_phases(sizes_, 1, work);
}

template <class Value>
Eigen::MatrixXd SupernodalSolve::solve(const Value* values, const Eigen::MatrixXd& rhs) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  Eigen::Index column = 0;
  for (; column + 2 <= rhs.cols(); column += 2) solve<2>(values, rhs.col(column).data(), solution.col(column).data());
  if (column < rhs.cols()) solve<1>(values, rhs.col(column).data(), solution.col(column).data());
  return solution;
}

template Eigen::MatrixXd SupernodalSolve::solve(const double*, const Eigen::MatrixXd&) const;
template Eigen::MatrixXd SupernodalSolve::solve(const float*, const Eigen::MatrixXd&) const;

}  // namespace scree::thermal
