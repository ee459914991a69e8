#include "thermal/supernodal_solve.h"

#include <algorithm>

#include "engine/base/phases.h"

namespace scree::thermal {

namespace {

// Trees are cut until each holds at most this part of the factor. What is above them is shared less well.
constexpr std::int64_t parts = 4;
// Factors with fewer entries are done before a second thread has woken up.
constexpr std::int64_t entries_worth_sharing = 200'000;

// -1: a root.
std::vector<int> parents_of(const SupernodalPattern& pattern) {
  std::vector<int> holder(pattern.unknowns);  // the supernode of each column
  for (int s = 0; s < pattern.supernodes; ++s) {
    std::fill(holder.begin() + pattern.first[s], holder.begin() + pattern.first[s + 1], s);
  }
  std::vector<int> parents(pattern.supernodes, -1);
  for (int s = 0; s < pattern.supernodes; ++s) {
    const int columns = pattern.first[s + 1] - pattern.first[s];
    if (pattern.rows_of(s) > columns) parents[s] = holder[pattern.rows[pattern.rows_begin[s] + columns]];
  }
  return parents;
}

// Of the tree below each supernode, itself included. Parents come after what is below them.
std::vector<std::int64_t> entries_below(const SupernodalPattern& pattern, const std::vector<int>& parents) {
  std::vector<std::int64_t> entries(pattern.supernodes);
  for (int s = 0; s < pattern.supernodes; ++s) {
    entries[s] += static_cast<std::int64_t>(pattern.rows_of(s)) * (pattern.first[s + 1] - pattern.first[s]);
    if (parents[s] >= 0) entries[parents[s]] += entries[s];
  }
  return entries;
}

}  // namespace

SupernodalSolve::SupernodalSolve(const SupernodalPattern& pattern) : pattern_(pattern) {
  const std::vector<int> parents = parents_of(pattern);
  cut(parents, entries_below(pattern, parents));
}

void SupernodalSolve::cut(const std::vector<int>& parents, const std::vector<std::int64_t>& entries) {
  const int count = pattern_.supernodes;
  std::int64_t all = 0;
  for (int s = 0; s < count; ++s) all += parents[s] < 0 ? entries[s] : 0;
  const std::int64_t largest = std::max(all / parts, entries_worth_sharing);

  // Which task a supernode belongs to: parents first.
  constexpr int in_top = -1;
  std::vector<int> task(count, in_top);
  for (int s = count - 1; s >= 0; --s) {
    const int above = parents[s] < 0 ? in_top : task[parents[s]];
    if (above != in_top) {
      task[s] = above;
    } else if (entries[s] <= largest) {
      // Small trees go together.
      if (tasks_.empty() || tasks_.back().entries + entries[s] > largest) tasks_.emplace_back();
      tasks_.back().entries += entries[s];
      task[s] = static_cast<int>(tasks_.size()) - 1;
    }
  }
  std::vector<int> top;
  for (int s = 0; s < count; ++s) (task[s] == in_top ? top : tasks_[task[s]].supernodes).push_back(s);
  std::stable_sort(tasks_.begin(), tasks_.end(), [](const Task& a, const Task& b) { return a.entries > b.entries; });
  top_.set(pattern_, top);
  // Up the trees, where they meet, the top, down the trees.
  const auto trees = static_cast<int>(tasks_.size());
  sizes_ = {trees, 1};
  sizes_.insert(sizes_.end(), top_.sizes().begin(), top_.sizes().end());
  sizes_.push_back(trees);
  find_rows_above(top);
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
void SupernodalSolve::forward(const Task& task, const Value* values, double* x, double* above) const {
  std::vector<double> w(sides * most_rows_);
  for (const int s : task.supernodes) {
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
void SupernodalSolve::backward(const Task& task, const Value* values, double* x) const {
  std::vector<double> w(sides * most_rows_);
  for (auto s = task.supernodes.rbegin(); s != task.supernodes.rend(); ++s) {
    const Supernode<Value> node = pattern_.supernode(values, *s);
    pattern_.load<sides>(*s, node.rows, x, w.data());
    thermal::backward<sides>(node, {0, node.columns}, node.rows, w.data());
    pattern_.store<sides>(*s, node.columns, w.data(), x);
  }
}

template <int sides, class Value>
void SupernodalSolve::solve(const Value* values, const double* rhs, double* solution) const {
  const int n = pattern_.unknowns;
  std::vector<double> x(static_cast<std::size_t>(sides) * n);
  for (int c = 0; c < sides; ++c) {
    for (int i = 0; i < n; ++i) x[sides * i + c] = rhs[static_cast<std::ptrdiff_t>(c) * n + pattern_.permutation[i]];
  }
  std::vector<std::vector<double>> above(tasks_.size());
  TopSupernodes::Space space = top_.space<sides>();
  const auto meet = [&] {
    for (const auto& part : above) {
      for (std::size_t i = 0; i < top_rows_.size(); ++i) {
        for (int c = 0; c < sides; ++c) x[sides * top_rows_[i] + c] += part[sides * i + c];
      }
    }
  };
  const auto work = [&](int phase, int task) {
    if (phase == 0) {
      above[task].assign(sides * top_rows_.size(), 0.0);
      forward<sides>(tasks_[task], values, x.data(), above[task].data());
    } else if (phase == 1) {
      meet();
    } else if (phase + 1 < static_cast<int>(sizes_.size())) {
      top_.run<sides>(phase - 2, task, values, x.data(), space);
    } else {
      backward<sides>(tasks_[task], values, x.data());
    }
  };
  run_phases(sizes_, 1, work);
  for (int c = 0; c < sides; ++c) {
    for (int i = 0; i < n; ++i) solution[static_cast<std::ptrdiff_t>(c) * n + pattern_.permutation[i]] = x[sides * i + c];
  }
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
