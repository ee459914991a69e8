#include "contact/near_faces.h"

#include <algorithm>
#include <vector>

#include "contact/block_elements.h"
#include "contact/box_grid.h"
#include "engine/base/chunks.h"
#include "engine/base/collected.h"

namespace scree::contact {

namespace {

// Holds whatever the element's faces may touch, and so their box in the coarse search.
template <int dim>
Aabb<dim> reached_by(const mesh::BlockMesh<dim>& mesh, ElementId element, const ShellOptions& options) {
  Aabb<dim> box = element_box(mesh, element);
  // No edge is longer than the diagonal.
  const double margin = 1.001 * (widest_shift * options.indentation + options.tolerance) * box.diagonal().norm();
  box.min().array() -= margin;
  box.max().array() += margin;
  return box;
}

template <int dim>
class NearFaces {
 public:
  NearFaces(const mesh::BlockMesh<dim>& mesh, const Table<FaceId, mesh::Face<dim>>& faces, const ShellOptions& options)
      : mesh_(mesh),
        faces_(faces),
        options_(options),
        starts_(block_starts(mesh, faces)),
        boxes_(block_boxes()),
        grid_(boxes_),
        near_(mesh.nodes.size(), false) {
    for_chunks(chunks_by_size(starts_, chunk_size), [&](Chunk blocks) {
      for (std::size_t block = blocks.begin; block < blocks.end; ++block) mark(BlockId{block});
    });
  }

  // The faces of one element are kept whatever is around.
  [[nodiscard]] bool is_near(const mesh::Face<dim>& face) const {
    const auto near = [&](NodeId node) { return near_[node.index()] != 0; };
    return is_whole(mesh_, face.block) || std::any_of(face.nodes.begin(), face.nodes.end(), near);
  }

 private:
  // Calls visit(element) for the elements behind the faces of a block.
  template <class Visit>
  void for_each_element(BlockId block, const Visit& visit) const {
    ElementId last;
    for (std::size_t f = starts_[block.index()]; f < starts_[block.index() + 1]; ++f) {
      const ElementId element = faces_[FaceId{f}].element;
      if (element != last) visit(element);
      last = element;
    }
  }

  [[nodiscard]] std::vector<Aabb<dim>> block_boxes() const {
    std::vector<Aabb<dim>> boxes(mesh_.blocks.size());
    for_chunks(chunks_by_size(starts_, chunk_size), [&](Chunk blocks) {
      for (std::size_t block = blocks.begin; block < blocks.end; ++block) {
        Aabb<dim> box;  // not in its place, beside which another thread may write
        for_each_element(BlockId{block}, [&](ElementId e) { box.extend(reached_by(mesh_, e, options_)); });
        boxes[block] = box;
      }
    });
    return boxes;
  }

  // Marks the nodes of the elements of a block of several that come near another one.
  void mark(BlockId block) {
    if (is_whole(mesh_, block)) return;
    const std::vector<Aabb<dim>> others = others_near(block, boxes_[block.index()]);
    if (others.empty()) return;
    for_each_element(block, [&](ElementId element) {
      if (!comes_near(block, element, others)) return;
      for (const NodeId node : mesh_.elements[element]) near_[node.index()] = true;
    });
  }

  [[nodiscard]] bool comes_near(BlockId block, ElementId element, const std::vector<Aabb<dim>>& others) const {
    constexpr std::size_t few = 32;
    const Aabb<dim> box = reached_by(mesh_, element, options_);
    if (others.size() > few) return !others_near(block, box).empty();
    return std::any_of(others.begin(), others.end(), [&](const Aabb<dim>& other) { return other.intersects(box); });
  }

  // The boxes of other blocks that meet a box.
  [[nodiscard]] std::vector<Aabb<dim>> others_near(BlockId block, const Aabb<dim>& box) const {
    Places found;
    grid_.find(box, found);
    std::vector<Aabb<dim>> others;
    for (const auto place : found) {
      if (grid_.order()[place] != block.index()) others.push_back(boxes_[grid_.order()[place]]);
    }
    return others;
  }

  const mesh::BlockMesh<dim>& mesh_;
  const Table<FaceId, mesh::Face<dim>>& faces_;
  const ShellOptions& options_;
  std::vector<std::size_t> starts_;  // of the faces of each block, and the end
  std::vector<Aabb<dim>> boxes_;     // of the blocks
  BoxGrid<dim> grid_;
  std::vector<char> near_;  // of each node
};

}  // namespace

template <int dim>
Table<FaceId, mesh::Face<dim>> near_faces(const mesh::BlockMesh<dim>& mesh, Table<FaceId, mesh::Face<dim>> faces,
                                          const ShellOptions& options) {
  if (mesh.blocks.size() == mesh.elements.size()) return faces;
  const NearFaces<dim> near(mesh, faces, options);
  return Table<FaceId, mesh::Face<dim>>(
      collected<std::vector<mesh::Face<dim>>>(faces.size(), [&](Chunk chunk, std::vector<mesh::Face<dim>>& kept) {
        for (std::size_t f = chunk.begin; f < chunk.end; ++f) {
          if (near.is_near(faces[FaceId{f}])) kept.push_back(faces[FaceId{f}]);
        }
      }));
}

#define SCREE_INSTANTIATE(dim)                                                                                         \
  template Table<FaceId, mesh::Face<dim>> near_faces<dim>(const mesh::BlockMesh<dim>&, Table<FaceId, mesh::Face<dim>>, \
                                                          const ShellOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
