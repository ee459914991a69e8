// The faces that belong to one element or cell only, in linear time whatever the size of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace scree::mesh {

// `for_each_face(visit)` calls visit(nodes) with the nodes of every face, ascending, those of a block of `nodes` nodes from 0.
// Returns the places, in that order, of the faces whose nodes no other face has, ascending.
template <std::size_t corners, class ForEachFace>
std::vector<std::uint32_t> lone_faces(std::size_t nodes, const ForEachFace& for_each_face) {
  using Face = std::array<std::uint32_t, corners>;
  struct Use {
    std::array<std::uint32_t, corners - 1> others;  // than the least node
    std::uint32_t place;

    auto operator<=>(const Use&) const = default;
  };
  std::vector<std::uint32_t> begin(nodes + 1, 0);  // of each least node's uses, and the end
  for_each_face([&](const Face& face) { ++begin[face.front() + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Use> uses(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  std::uint32_t place = 0;
  for_each_face([&](const Face& face) {
    Use& use = uses[next[face.front()]++];
    std::copy(face.begin() + 1, face.end(), use.others.begin());
    use.place = place++;
  });
  std::vector<std::uint32_t> alone;
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto first = uses.begin() + begin[node], last = uses.begin() + begin[node + 1];
    std::sort(first, last);
    for (auto use = first; use != last;) {
      const auto other = std::find_if(use, last, [&](const Use& u) { return u.others != use->others; });
      if (other == use + 1) alone.push_back(use->place);
      use = other;
    }
  }
  std::sort(alone.begin(), alone.end());
  return alone;
}

}  // namespace scree::mesh
