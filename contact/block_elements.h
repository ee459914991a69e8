// Whether a point is in a block: the elements of blocks of several by cells of space.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "contact/box_grid.h"
#include "engine/mesh/block_mesh.h"

namespace scree::contact {

template <int dim>
Aabb<dim> element_box(const mesh::BlockMesh<dim>& mesh, ElementId element) {
  Aabb<dim> box;
  for (const NodeId node : mesh.elements[element]) box.extend(mesh.nodes[node]);
  return box;
}

template <int dim>
class BlockElements {
 public:
  explicit BlockElements(const mesh::BlockMesh<dim>& mesh);  // of the caller, who keeps it

  // Asks one of the block's elements first: the one behind a face is nearly always the one. From any thread; the elements of a
  // block are sorted when they are first looked through.
  [[nodiscard]] bool hold(BlockId block, ElementId first, const Point<dim>& point) const;

 private:
  struct OfBlock {
    Aabb<dim> box;
    std::once_flag sorted;
    std::unique_ptr<BoxGrid<dim>> elements;
  };

  [[nodiscard]] bool is_in(ElementId element, const Point<dim>& point) const;
  const BoxGrid<dim>& elements_of(BlockId block) const;

  const mesh::BlockMesh<dim>& mesh_;
  mutable std::vector<OfBlock> blocks_;  // none where all blocks are single elements
};

}  // namespace scree::contact
