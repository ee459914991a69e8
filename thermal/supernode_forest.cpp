#include "thermal/supernode_forest.h"

#include <algorithm>
#include <numeric>
#include <utility>

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

using Tree = CutForest::Tree;

// The heaviest whole trees of the forest that are no heavier, the others cut from their roots down.
CutForest cut(const std::vector<std::int64_t>& weights, const std::vector<int>& parents, std::int64_t heaviest) {
  const std::vector<std::int64_t> below = weights_below(weights, parents);
  CutForest forest;
  // Which tree a supernode belongs to: parents first.
  constexpr int in_top = -1;
  std::vector<int> tree(weights.size(), in_top);
  for (std::size_t s = weights.size(); s-- > 0;) {
    const int above = parents[s] < 0 ? in_top : tree[parents[s]];
    if (above != in_top) {
      tree[s] = above;
    } else if (below[s] <= heaviest) {
      tree[s] = static_cast<int>(forest.trees.size());
      forest.trees.push_back({{}, below[s]});
    }
  }
  for (std::size_t s = 0; s < weights.size(); ++s) {
    (tree[s] == in_top ? forest.top : forest.trees[tree[s]].supernodes).push_back(static_cast<int>(s));
  }
  return forest;
}

void sort_by_weight(std::vector<Tree>& trees) {
  std::stable_sort(trees.begin(), trees.end(), [](const Tree& a, const Tree& b) { return a.weight > b.weight; });
}

// The heaviest tree first, each to the group that weighs least so far.
std::vector<Tree> grouped(std::vector<Tree> trees, std::size_t groups) {
  sort_by_weight(trees);
  std::vector<Tree> together(groups);
  for (const Tree& tree : trees) {
    Tree& group =
        *std::min_element(together.begin(), together.end(), [](const Tree& a, const Tree& b) { return a.weight < b.weight; });
    group.weight += tree.weight;
    group.supernodes.insert(group.supernodes.end(), tree.supernodes.begin(), tree.supernodes.end());
  }
  for (Tree& group : together) std::sort(group.supernodes.begin(), group.supernodes.end());
  return together;
}

// Of each four the heaviest and the lightest are in the first half.
std::vector<Tree> in_like_halves(std::vector<Tree> trees) {
  sort_by_weight(trees);
  std::vector<Tree> halves;
  for (const bool first : {true, false}) {
    for (std::size_t i = 0; i < trees.size(); ++i) {
      if ((i % 4 == 0 || i % 4 == 3) == first) halves.push_back(std::move(trees[i]));
    }
  }
  return halves;
}

}  // namespace

CutForest cut_forest(const SupernodalPattern& pattern, const std::vector<std::int64_t>& weights, int parts,
                     std::int64_t least) {
  const std::int64_t heaviest = std::max(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}) / parts, least);
  CutForest forest = cut(weights, parents_of(pattern), heaviest);
  std::int64_t all = 0;
  for (const Tree& tree : forest.trees) all += tree.weight;
  const std::int64_t groups = all <= heaviest ? 1 : 2 * ((all - 1) / (2 * heaviest) + 1);
  forest.trees = in_like_halves(grouped(std::move(forest.trees), std::min<std::size_t>(groups, forest.trees.size())));
  return forest;
}

}  // namespace scree::thermal
