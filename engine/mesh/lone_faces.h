// The faces that belong to one element or cell only, in linear time whatever the size of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace scree::mesh {

// `for_each_face(visit)` calls visit(nodes, place) with the nodes of every face, ascending, those of a block of `nodes` nodes
// from 0; places are numbers from 0, one for each face, and every call gives the same. Returns the places of the faces whose
// nodes no other face has, ascending.
template <std::size_t corners, class ForEachFace>
std::vector<std::uint32_t> lone_faces(std::size_t nodes, const ForEachFace& for_each_face) {
  using Others = std::array<std::uint32_t, corners - 1>;  // nodes of a face but the least
  struct Entry {
    Others others;
    std::uint32_t place;

    // Without a branch, and without the call of a function that == of arrays is.
    [[nodiscard]] std::uint8_t other_nodes(const Entry& other) const {
      std::uint32_t different = 0;
      for (std::size_t i = 0; i + 1 < corners; ++i) different |= others[i] ^ other.others[i];
      return different != 0 ? 1 : 0;
    }
  };
  // Faces that are the same have the same least node and the same sum: some bits of it leave few to compare with.
  constexpr std::uint32_t sums = 8;
  const auto group = [](const std::array<std::uint32_t, corners>& face) {
    return std::size_t{sums} * face.front() + std::accumulate(face.begin() + 1, face.end(), 0u) % sums;
  };
  const std::size_t groups = nodes * sums;
  std::vector<std::uint32_t> end(groups + 1, 0);  // of each group's entries
  for_each_face([&](const std::array<std::uint32_t, corners>& face, std::uint32_t) { ++end[group(face) + 1]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Entry> entries(end.back());
  for_each_face([&](const std::array<std::uint32_t, corners>& face, std::uint32_t place) {
    Entry& entry = entries[end[group(face)]++];
    for (std::size_t i = 0; i + 1 < corners; ++i) entry.others[i] = face[i + 1];
    entry.place = place;
  });
  // Each end has moved from where its group's entries begin to where they end. All without branches: half of the faces compared
  // are the same, which no one could foretell.
  std::vector<std::uint8_t> lone(entries.size(), 1);
  std::uint32_t begin = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    for (std::uint32_t i = begin; i < end[g]; ++i) {
      for (std::uint32_t j = begin; j < i; ++j) {
        const std::uint8_t other = entries[i].other_nodes(entries[j]);
        lone[entries[i].place] &= other;
        lone[entries[j].place] &= other;
      }
    }
    begin = end[g];
  }
  std::vector<std::uint32_t> alone(lone.size());
  std::size_t count = 0;
  for (std::uint32_t place = 0; place < lone.size(); ++place) {
    alone[count] = place;
    count += lone[place];
  }
  alone.resize(count);
  return alone;
}

// Of triangles or tetrahedra: places are (dim + 1) times the number of the simplex and the corner opposite to the face.
// `nodes_of(simplex)` gives its nodes.
template <int dim, class NodesOf>
std::vector<std::uint32_t> lone_simplex_faces(std::size_t nodes, std::size_t simplices, const NodesOf& nodes_of) {
  constexpr std::size_t corners = dim + 1;
  return lone_faces<dim>(nodes, [&](const auto& visit) {
    for (std::size_t simplex = 0; simplex < simplices; ++simplex) {
      // Sorted once for all faces and without a branch, which no one could foretell.
      std::array<std::uint64_t, corners> ascending;  // nodes, and in the lowest bits which corner it is
      const std::array<std::uint32_t, corners> own = nodes_of(simplex);
      for (std::size_t corner = 0; corner < corners; ++corner) ascending[corner] = std::uint64_t{own[corner]} << 2 | corner;
      const auto order = [&](std::size_t i, std::size_t j) {
        const std::uint64_t low = std::min(ascending[i], ascending[j]);
        ascending[j] = std::max(ascending[i], ascending[j]);
        ascending[i] = low;
      };
      if constexpr (dim == 3) {
        order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
      } else {
        order(0, 1), order(1, 2), order(0, 1);
      }
      for (std::size_t opposite = 0; opposite < corners; ++opposite) {
        std::array<std::uint32_t, dim> face;
        for (std::size_t i = 0; i < dim; ++i) {
          face[i] = static_cast<std::uint32_t>(ascending[i < opposite ? i : i + 1] >> 2);
        }
        visit(face, static_cast<std::uint32_t>(corners * simplex + (ascending[opposite] & 3)));
      }
    }
  });
}

}  // namespace scree::mesh
