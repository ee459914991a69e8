#include "thermal/supernode_forest.h"

#include <algorithm>
#include <numeric>

namespace scree::thermal {

namespace {

// -1: a root.
std::vector<int> parents_of(const SupernodalPattern& pattern) {
  const std::vector<int> holder = pattern.holders();
  std::vector<int> parents(pattern.supernodes, -1);
  for (int s = 0; s < pattern.supernodes; ++s) {
    const int columns = pattern.columns_of(s);
    if (pattern.rows_of(s) > columns) parents[s] = holder[pattern.row(s, columns)];
  }
  return parents;
}

// Of the tree below each supernode, itself included. Parents come after what is below them.
std::vector<std::int64_t> weights_below(std::vector<std::int64_t> weights, const std::vector<int>& parents) {
  for (std::size_t s = 0; s < weights.size(); ++s) {
    if (parents[s] >= 0) weights[parents[s]] += weights[s];
  }
  return weights;
}

}  // namespace

CutForest cut_forest(const SupernodalPattern& pattern, const std::vector<std::int64_t>& weights, int parts,
                     std::int64_t least) {
  const std::int64_t heaviest = std::max(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}) / parts, least);
  const std::vector<int> parents = parents_of(pattern);
  const std::vector<std::int64_t> below = weights_below(weights, parents);
  CutForest forest;
  std::vector<CutForest::Tree>& trees = forest.trees;
  // Which tree a supernode belongs to: parents first.
  constexpr int in_top = -1;
  std::vector<int> tree(pattern.supernodes, in_top);
  for (int s = pattern.supernodes - 1; s >= 0; --s) {
    const int above = parents[s] < 0 ? in_top : tree[parents[s]];
    if (above != in_top) {
      tree[s] = above;
    } else if (below[s] <= heaviest) {
      if (trees.empty() || trees.back().weight + below[s] > heaviest) trees.emplace_back();
      trees.back().weight += below[s];
      tree[s] = static_cast<int>(trees.size()) - 1;
    }
  }
  for (int s = 0; s < pattern.supernodes; ++s) (tree[s] == in_top ? forest.top : trees[tree[s]].supernodes).push_back(s);
  std::stable_sort(trees.begin(), trees.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  return forest;
}

}  // namespace scree::thermal
