#include "contact/edge_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "contact/choice.h"
#include "contact/edge_bounds.h"
#include "contact/tetrahedron.h"
#include "engine/base/collected.h"
#include "engine/base/grouped.h"

namespace scree::contact {

namespace {

// Which of twelve blocks is this one, a bit for each three of them.
unsigned threes_with(const BlockId* blocks, BlockId block) {
  static_assert(sizeof(BlockId) == sizeof(int));
  const int asked = block.value();
  unsigned all = 0;
  for (int four = 0; four < 3; ++four) {
    LaneMask some;
    std::memcpy(&some, blocks + lane_count * four, sizeof some);
    all |= bits(some == LaneMask{asked, asked, asked, asked}) << lane_count * four;
  }
  all |= all >> 1 | all >> 2;
  return (all & 1u) | (all >> 2 & 2u) | (all >> 4 & 4u) | (all >> 6 & 8u);
}

// Which edges of a shell have a face with a semi-spring whose target is on a block, one bit each.
unsigned edges_on(const Shell<3>& shell, const LargeVector<BlockId>& spring_blocks, BlockId block) {
  const BlockId* spring = spring_blocks.data() + shell.first.index() * 3;
  if (shell.faces == 0xfu) return edges_of_faces[threes_with(spring, block)];
  unsigned faces = 0;
  for (unsigned f = 0; f < 4; ++f) {
    if ((shell.faces >> f & 1u) == 0) continue;
    const bool on = spring[0] == block || spring[1] == block || spring[2] == block;
    faces |= (on ? 1u : 0u) << f;
    spring += 3;
  }
  return edges_of_faces[faces];
}

// A semi-edge (face * 3 + side) and a target edge.
struct Touching : Candidate<EdgeId> {
  std::uint32_t semi_edge;
  EdgeTouch touch;
};

// Asks the semi-edges of two shells about the edges of each other.
class Asking {
 public:
  Asking(const Surface<3>& surface, const ContactOptions& options, const LargeVector<BlockId>& spring_blocks,
         std::vector<Touching>& found)
      : surface_(surface), options_(options), spring_blocks_(spring_blocks), found_(found) {}

  void ask(const Shell<3>& first, const Shell<3>& second, EdgePairs edges) {
    // Where semi-springs join the blocks of the two, edges of their faces do not.
    edges &= ~pairs_of_first(edges_on(first, spring_blocks_, second.block));
    edges &= ~pairs_of_second(edges_on(second, spring_blocks_, first.block));
    if (edges == 0) return;
    asked_.push_back({&first, &second, edges});
    if (asked_.size() == many) touch_asked();
  }

  void finish() { touch_asked(); }

 private:
  static constexpr std::size_t many = 32;

  struct Possible {
    FaceId own;
    int side;
    EdgeId target;
  };

  void touch_asked() {
    find_touching_edges(asked_, options_.indentation, touching_);
    for (std::size_t i = 0; i < asked_.size(); ++i) list(*asked_[i].first, *asked_[i].second, touching_[i]);
    asked_.clear();
    touch_possible();
  }

  void list(const Shell<3>& first, const Shell<3>& second, const TouchingEdges& touching) {
    for (std::size_t k = 0; k < 2; ++k) {
      for (EdgePairs left = touching.of_first[k]; left != 0; left &= left - 1) {
        const int pair = std::countr_zero(left);
        list(first, pair / 6, k, second, pair % 6);
      }
      for (EdgePairs left = touching.of_second[k]; left != 0; left &= left - 1) {
        const int pair = std::countr_zero(left);
        list(second, pair % 6, k, first, pair / 6);
      }
    }
  }

  // What touch_edge asks for lies here and there in memory, so it is fetched for many semi-edges at once, before the first is
  // touched.
  void touch_possible() {
    for (const auto& [own, side, target] : possible_) {
      __builtin_prefetch(&surface_.mesh.nodes[surface_.faces[own].nodes[0]]);
      __builtin_prefetch(&surface_.mesh.nodes[surface_.edges[target].nodes[0]]);
      __builtin_prefetch(&surface_.faces[surface_.edges[target].faces[0]]);
      __builtin_prefetch(&surface_.normals[surface_.edges[target].faces[0]]);
      __builtin_prefetch(&surface_.edges[surface_.face_edges[own][side]]);
    }
    for (const auto& [own, side, target] : possible_) {
      const auto touch = touch_edge(surface_, options_, own, side, target);
      if (!touch || joined_by_springs(own, side, target)) continue;
      const auto semi_edge = static_cast<std::uint32_t>(own.index() * 3 + static_cast<std::size_t>(side));
      found_.push_back({{target, std::abs(touch->gap), std::abs(touch->along - 0.5)}, semi_edge, *touch});
    }
    possible_.clear();
  }

  // The semi-edge in the k-th face beside an edge of the owner, and an edge of another shell.
  void list(const Shell<3>& owner, int edge, std::size_t k, const Shell<3>& other, int target_edge) {
    const int face = element_edges[edge].beside[k];
    if ((owner.faces >> face & 1u) == 0 || (other.edges >> target_edge & 1u) == 0) return;
    const bool whole = owner.whole && other.whole;
    if (whole && !may_face(owner, element_edges[edge], face, other, element_edges[target_edge])) return;
    const FaceId own = owner.face(face);
    const int side = side_of(element_edges[edge], face);
    const EdgeId target = other.targets[target_edge];
    possible_.push_back({own, side, target});
    __builtin_prefetch(&surface_.faces[own]);
    __builtin_prefetch(&surface_.normals[own]);
    __builtin_prefetch(&surface_.face_edges[own]);
    __builtin_prefetch(&surface_.edges[target]);
  }

  // Does a semi-spring of a face at the semi-edge's edge have its target on the block of the target edge, or one of a face
  // there on this block? Such a face may belong to another shell than the edge was found in.
  bool joined_by_springs(FaceId own, int side, EdgeId target) const {
    const SurfaceEdge& own_edge = surface_.edges[surface_.face_edges[own][side]];
    const SurfaceEdge& other_edge = surface_.edges[target];
    return any_on(own_edge.faces, surface_.faces[other_edge.faces[0]].block) ||
           any_on(other_edge.faces, surface_.faces[own].block);
  }

  bool any_on(const std::array<FaceId, 2>& faces, BlockId block) const {
    for (const FaceId face : faces) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (spring_blocks_[face.index() * 3 + corner] == block) return true;
      }
    }
    return false;
  }

  const Surface<3>& surface_;
  const ContactOptions& options_;
  const LargeVector<BlockId>& spring_blocks_;
  std::vector<Touching>& found_;
  std::vector<ShellEdges> asked_;
  std::vector<TouchingEdges> touching_;
  std::vector<Possible> possible_;
};

// What each semi-edge takes of those that it touches, in the order of the semi-edges.
std::vector<TakenEdge> taken_of(const Surface<3>& surface, const std::vector<std::vector<Touching>>& parts) {
  const auto by_face = grouped<Touching>(parts.size(), surface.faces.size(), [&](std::size_t part, const auto& visit) {
    for (const Touching& touching : parts[part]) visit(touching.semi_edge / 3, touching);
  });
  return collected<std::vector<TakenEdge>>(surface.faces.size(), [&](Chunk chunk, std::vector<TakenEdge>& taken) {
    std::vector<Touching> candidates;
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
      const std::span<const Touching> of_face = by_face.of(f);
      if (of_face.empty()) continue;
      for (int side = 0; side < 3; ++side) {
        const auto semi_edge = static_cast<std::uint32_t>(f * 3 + static_cast<std::size_t>(side));
        candidates.clear();
        for (const Touching& touching : of_face) {
          if (touching.semi_edge == semi_edge) candidates.push_back(touching);
        }
        const Touching* best = best_of(candidates, equal_distance * surface.lengths[FaceId{f}]);
        if (best != nullptr) taken.push_back({semi_edge, best->target, best->touch});
      }
    }
  });
}

}  // namespace

std::vector<TakenEdge> find_edge_targets(const Surface<3>& surface, const ContactOptions& options, const ShellTable<3>& table,
                                         Parts<NearEdges>& near, const LargeVector<BlockId>& spring_blocks) {
  std::vector<std::vector<Touching>> parts(near.count());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < near.count(); ++i) {
    Asking asking(surface, options, spring_blocks, parts[i]);
    const auto pairs = near[i];
    for (std::size_t n = 0; n < pairs.size(); ++n) {
      constexpr std::size_t ahead = 4;
      __builtin_prefetch(&table.shells[pairs[std::min(n + ahead, pairs.size() - 1)].second]);
      asking.ask(table.shells[pairs[n].first], table.shells[pairs[n].second], pairs[n].edges);
    }
    asking.finish();
  }
  near.clear();
  return taken_of(surface, parts);
}

}  // namespace scree::contact
