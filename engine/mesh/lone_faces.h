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
  struct Entry {
    std::array<std::uint32_t, corners - 1> others;  // than the least node
    std::uint32_t place;

    // Without a branch, and without the call of a function that == of arrays is.
    [[nodiscard]] bool same_nodes(const Entry& other) const {
      std::uint32_t different = 0;
      for (std::size_t i = 0; i + 1 < corners; ++i) different |= others[i] ^ other.others[i];
      return different == 0;
    }
  };
  std::vector<std::uint32_t> begin(nodes + 1, 0);  // of each least node's entries, and the end
  for_each_face([&](const Face& face) { ++begin[face.front() + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Entry> entries(begin.back());  // each face once, as it comes first
  std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
  std::vector<char> lone(begin.back(), true);
  std::uint32_t places = 0;
  for_each_face([&](const Face& face) {
    Entry entry{{}, places++};
    std::copy(face.begin() + 1, face.end(), entry.others.begin());
    const auto first = entries.begin() + begin[face.front()], last = entries.begin() + end[face.front()];
    const auto same = std::find_if(first, last, [&](const Entry& other) { return other.same_nodes(entry); });
    if (same == last) {
      entries[end[face.front()]++] = entry;
    } else {
      lone[same->place] = lone[entry.place] = false;
    }
  });
  std::vector<std::uint32_t> alone;
  for (std::uint32_t place = 0; place < places; ++place) {
    if (lone[place]) alone.push_back(place);
  }
  return alone;
}

}  // namespace scree::mesh
