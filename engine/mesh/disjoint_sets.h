// Which of n things belong together.
#pragma once

#include <numeric>
#include <vector>

namespace scree::mesh {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  // The members of each set, in the order of `members`; sets in the order of their first members.
  template <class Members, class ThingOf>
  std::vector<std::vector<std::size_t>> groups(const Members& members, const ThingOf& thing_of) {
    constexpr auto none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> place(parent_.size(), none), counts;
    for (std::size_t i = 0; i < members.size(); ++i) {
      std::size_t& at = place[root(thing_of(i))];
      if (at == none) {
        at = counts.size();
        counts.push_back(0);
      }
      ++counts[at];
    }
    std::vector<std::vector<std::size_t>> sets(counts.size());
    for (std::size_t set = 0; set < sets.size(); ++set) sets[set].reserve(counts[set]);
    for (std::size_t i = 0; i < members.size(); ++i) sets[place[root(thing_of(i))]].push_back(i);
    return sets;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace scree::mesh
