// Coarse search: which faces come near which, by cells of space.
//
// Faces are sorted into levels by size, each level four times as coarse as the one below, and entered in every cell of their
// level that their plane crosses. A face looks into the cells it crosses on its own level and on every coarser one. So a face
// crosses a bounded number of cells whatever the range of sizes, and time and memory are linear in the number of faces.
// The cells of a level are a hash table in two flat arrays; two cells that share a slot only cost needless candidates.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/base/ids.h"

namespace scree::contact {

// A face as the grid sees it.
template <int dim>
struct FaceBounds {
  Aabb<dim> box;      // grown by `reach`
  Point<dim> normal;  // unit
  double offset = 0;  // of the face's plane: normal . x = offset [m]
  double reach = 0;   // how far the face looks for others [m]
  BlockId block;
};

template <int dim>
class FaceGrid {
 public:
  explicit FaceGrid(const Table<FaceId, FaceBounds<dim>>& faces);

  // What one caller (one thread) needs to ask again and again without allocating.
  struct Scratch {
    std::vector<std::int32_t> seen_by;  // the last face that met each face
    std::vector<FaceId> found;
  };
  [[nodiscard]] Scratch make_scratch() const;

  // Leaves in scratch.found the faces of other blocks whose box meets the face's own, in no order of note. Of every two faces
  // that meet, just one finds the other.
  void find(FaceId face, Scratch& scratch) const;

 private:
  struct Level {
    int order = 0;  // 0 is the level of the median face
    double cells_per_metre = 0;
    std::uint64_t mask = 0;
    std::vector<std::uint32_t> starts;  // of each slot in `entries`
    std::vector<std::int32_t> entries;
  };

  void assign_orders();
  void fill(Level& level, const std::vector<std::int32_t>& members) const;
  template <class Visit>
  void visit_slots(const FaceBounds<dim>& face, const Level& level, const Visit& visit) const;

  const Table<FaceId, FaceBounds<dim>>& faces_;  // of the caller, who keeps them
  Point<dim> origin_ = Point<dim>::Zero();
  double median_size_ = 1;           // [m]
  std::vector<std::int8_t> orders_;  // of each face
  std::vector<Level> levels_;        // from fine to coarse
};

}  // namespace scree::contact
