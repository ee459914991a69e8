#include "contact/twin_faces.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>

#include "contact/semi_spring.h"
#include "engine/base/grouped.h"

namespace scree::contact {

namespace {

// Of a face: the same for the same corners in any order, and hardly ever for others.
using FaceKey = std::uint64_t;

// Every bit of the result depends on all bits (the last steps of SplitMix64, Steele et al. 2014).
FaceKey spread_bits(FaceKey bits) {
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111eb;
  return bits ^ bits >> 31;
}

template <int dim>
FaceKey key_of(const Point<dim>& point) {
  FaceKey key = 0;
  for (int i = 0; i < dim; ++i) key = spread_bits(key + std::bit_cast<FaceKey>(point[i] + 0.0));  // -0 + 0 is 0
  return key;
}

template <int dim>
LargeVector<FaceKey> keys_of(const Surface<dim>& surface) {
  LargeVector<FaceKey> keys(surface.faces.size());
  for_chunks(keys.size(), [&](Chunk chunk) {
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
      keys[f] = 0;
      for (const NodeId node : surface.faces[FaceId{f}].nodes) keys[f] += key_of<dim>(surface.mesh.nodes[node]);
    }
  });
  return keys;
}

// Is an eighth of the keys there twice? By all keys, or by a sample that holds both of two or none.
bool many_twice(const LargeVector<FaceKey>& keys) {
  constexpr std::size_t few = 4096;
  const FaceKey left_out = keys.size() > few ? 63 : 0;
  std::vector<FaceKey> sample;
  for (const FaceKey key : keys) {
    if ((key & left_out) == 0) sample.push_back(key);
  }
  std::sort(sample.begin(), sample.end());
  const std::size_t all = sample.size();
  sample.erase(std::unique(sample.begin(), sample.end()), sample.end());
  return 8 * (all - sample.size()) >= all;
}

// Of each corner of a face which one of the other it is; nothing if one is none of them.
template <int dim>
std::optional<std::array<int, dim>> same_corners(const Surface<dim>& surface, FaceId face, FaceId other) {
  const Corners<dim> own = corners_of(surface, face), its = corners_of(surface, other);
  std::array<int, dim> same;
  for (int i = 0; i < dim; ++i) {
    const auto found = std::find(its.begin(), its.end(), own[i]);
    if (found == its.end()) return std::nullopt;
    same[i] = static_cast<int>(found - its.begin());
  }
  return same;
}

struct KeyOf {
  FaceKey key;
  FaceId face;
};

// Of each key the only other one that is the same, if there is one.
LargeVector<FaceId> same_keys(const LargeVector<FaceKey>& keys) {
  // Groups by the highest bits, of one or two in the mean.
  const auto bits = static_cast<int>(std::bit_width(keys.size() / 2));
  const std::size_t groups = std::size_t{1} << bits;
  const auto grouped = grouped_by_number<KeyOf, std::uint32_t>(keys.size(), groups, [&](std::size_t face, const auto& visit) {
    visit(static_cast<std::uint32_t>(keys[face] >> 1 >> (63 - bits)), KeyOf{keys[face], FaceId{face}});
  });
  LargeVector<FaceId> others(keys.size());
  for_chunks(groups, [&](Chunk chunk) {
    for (std::size_t group = chunk.begin; group < chunk.end; ++group) {
      const std::span<const KeyOf> all = grouped.of(group);
      for (auto one = all.begin(); one != all.end(); ++one) {
        const auto same = [&](const KeyOf& other) { return other.key == one->key; };
        const auto other = std::find_if(one + 1, all.end(), same);
        if (other == all.end() || std::ranges::count_if(all, same) != 2) continue;
        others[one->face.index()] = other->face;
        others[other->face.index()] = one->face;
      }
    }
  });
  return others;
}

template <int dim>
class Twins {
 public:
  Twins(const Surface<dim>& surface, const ContactOptions& options, SpringTargets<dim>& targets)
      : surface_(surface), targets_(targets), weights_(all_semi_spring_weights<dim>(options.indentation)) {}

  void take(const LargeVector<FaceKey>& keys) {
    const LargeVector<FaceId> same = same_keys(keys);
    for_chunks(same.size(), [&](Chunk chunk) {
      for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
        if (same[f].valid() && FaceId{f} < same[f]) take_both(FaceId{f}, same[f]);
      }
    });
  }

 private:
  void take_both(FaceId face, FaceId other) {
    if (surface_.faces[face].block == surface_.faces[other].block) return;
    if (surface_.normals[face].dot(surface_.normals[other]) > 0) return;
    const auto there = same_corners(surface_, face, other);
    if (!there) return;
    std::array<int, dim> here{};
    for (int i = 0; i < dim; ++i) here[(*there)[i]] = i;
    take_one(face, other, *there);
    take_one(other, face, here);
  }

  void take_one(FaceId face, FaceId target, const std::array<int, dim>& same) {
    for (int corner = 0; corner < dim; ++corner) {
      SpringTouch<dim> touch{0, {}};
      for (int i = 0; i < dim; ++i) touch.on_target[same[i]] = weights_[corner][i];
      targets_.take(face.index() * dim + static_cast<std::size_t>(corner), target, surface_.faces[target].block, touch);
    }
  }

  const Surface<dim>& surface_;
  SpringTargets<dim>& targets_;
  std::array<std::array<double, dim>, dim> weights_;  // of a face's corners at the semi-spring of each
};

}  // namespace

template <int dim>
bool take_twins(const Surface<dim>& surface, const ContactOptions& options, SpringTargets<dim>& targets) {
  const LargeVector<FaceKey> keys = keys_of(surface);
  if (!many_twice(keys)) return false;
  Twins<dim>(surface, options, targets).take(keys);
  return true;
}

template bool take_twins<2>(const Surface<2>&, const ContactOptions&, SpringTargets<2>&);
template bool take_twins<3>(const Surface<3>&, const ContactOptions&, SpringTargets<3>&);

}  // namespace scree::contact
