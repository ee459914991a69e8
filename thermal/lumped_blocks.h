// Blocks of one temperature each: what the model keeps of them. README, "Lumped blocks".
//
// T = P T' gives every node of a lumped block its one unknown, so C' = P^T C P, K' = P^T K P and Q' = P^T Q: a block's own
// conduction falls out, heat is conserved as before, and a mesh with lumped blocks is a model like any other.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/curve.h"
#include "engine/base/ids.h"

namespace scree::thermal {

// How far from its mean a unit of heat flow through a patch brings a place of a block (inner_resistance.h).
struct PatchResistance {
  double bulk = 0;          // [K/W]
  double constriction = 0;  // [K/W]
};

inline PatchResistance largest_of(const PatchResistance& one, const PatchResistance& other) {
  return {std::max(one.bulk, other.bulk), std::max(one.constriction, other.constriction)};
}

// All contacts with one other block, all that one exchange reaches, or where one load sets heat free.
struct LumpedPatch {
  std::size_t number;  // of the other block; or of the exchange, or the load, counted on one from the other
  PatchResistance resists;
};

struct LumpedBlock {
  BlockId block;
  MaterialId material;
  NodeId row;                        // of the heat model
  double biot = 0;                   // conductances through its surface times what its inside resists (choose_lumped.h) [-]
  std::vector<LumpedPatch> patches;  // ascending
  double start_spread = 0;           // largest distance of a temperature at the start from the block's [K]
};

// Of a material.
struct LumpedConductivity {
  Curve value;       // [W/m/K]
  double least = 0;  // by which its blocks' resistances go: on the way between what is cold and hot at the start
};

class LumpedBlocks {
 public:
  LumpedBlocks(std::vector<LumpedBlock> ascending, std::size_t blocks, Table<MaterialId, LumpedConductivity> conductivities)
      : blocks_(std::move(ascending)), at_(blocks, -1), conductivities_(std::move(conductivities)) {
    for (std::size_t i = 0; i < blocks_.size(); ++i) at_[blocks_[i].block] = static_cast<int>(i);
  }

  [[nodiscard]] bool contain(BlockId block) const { return at_[block] >= 0; }
  // Its position in all(), or -1.
  [[nodiscard]] int position(BlockId block) const { return at_[block]; }

  // How many blocks there are, lumped or not.
  [[nodiscard]] std::size_t of_blocks() const { return at_.size(); }

  [[nodiscard]] const std::vector<LumpedBlock>& all() const { return blocks_; }
  [[nodiscard]] std::vector<LumpedBlock>& all() { return blocks_; }
  [[nodiscard]] const Table<MaterialId, LumpedConductivity>& conductivities() const { return conductivities_; }

 private:
  std::vector<LumpedBlock> blocks_;
  Table<BlockId, int> at_;
  Table<MaterialId, LumpedConductivity> conductivities_;
};

struct BiotRange {
  double least = 0;
  double largest = 0;
};

// Of the lumped blocks; of the others only auto knows one, and that it is no smaller than its limit.
inline BiotRange biot_range(const LumpedBlocks& lumped) {
  const auto [least, largest] = std::minmax_element(lumped.all().begin(), lumped.all().end(),
                                                    [](const LumpedBlock& a, const LumpedBlock& b) { return a.biot < b.biot; });
  return {least->biot, largest->biot};
}

}  // namespace scree::thermal
