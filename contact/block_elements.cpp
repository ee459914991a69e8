#include "contact/block_elements.h"

#include <algorithm>

#include <Eigen/LU>

#include "engine/base/chunks.h"

namespace scree::contact {

template <int dim>
BlockElements<dim>::BlockElements(const mesh::BlockMesh<dim>& mesh)
    : mesh_(mesh), blocks_(mesh.blocks.size() == mesh.elements.size() ? 0 : mesh.blocks.size()) {
  for_chunks(blocks_.size(), [&](Chunk chunk) {
    for (std::size_t block = chunk.begin; block < chunk.end; ++block) {
      Aabb<dim> box;  // not in its place, beside which another thread may write
      for (const NodeId node : mesh.blocks[BlockId{block}].nodes) box.extend(mesh.nodes[node]);
      blocks_[block].box = box;
    }
  });
}

template <int dim>
bool BlockElements<dim>::hold(BlockId block, ElementId first, const Point<dim>& point) const {
  constexpr std::size_t few = 32;
  if (is_in(first, point)) return true;
  const auto elements = mesh_.blocks[block].elements;
  if (elements.size() == 1 || !blocks_[block.index()].box.contains(point)) return false;
  const auto holds = [&](ElementId element) { return is_in(element, point); };
  if (elements.size() <= few) return std::any_of(elements.begin(), elements.end(), holds);
  const BoxGrid<dim>& sorted = elements_of(block);
  Places found;
  sorted.find(Aabb<dim>(point), found);
  return std::any_of(found.begin(), found.end(),
                     [&](std::uint32_t place) { return holds(ElementId{elements.first() + sorted.order()[place]}); });
}

template <int dim>
const BoxGrid<dim>& BlockElements<dim>::elements_of(BlockId block) const {
  OfBlock& of = blocks_[block.index()];
  std::call_once(of.sorted, [&] {
    std::vector<Aabb<dim>> boxes;
    for (const ElementId element : mesh_.blocks[block].elements) boxes.push_back(element_box(mesh_, element));
    of.elements = std::make_unique<BoxGrid<dim>>(boxes);
  });
  return *of.elements;
}

template <int dim>
bool BlockElements<dim>::is_in(ElementId element, const Point<dim>& point) const {
  const auto& nodes = mesh_.elements[element];
  Eigen::Matrix<double, dim, dim> edges;
  for (int i = 0; i < dim; ++i) edges.col(i) = mesh_.nodes[nodes[i + 1]] - mesh_.nodes[nodes[0]];
  const Point<dim> weights = edges.inverse() * (point - mesh_.nodes[nodes[0]]);
  return weights.minCoeff() >= 0 && weights.sum() <= 1;
}

template class BlockElements<2>;
template class BlockElements<3>;

}  // namespace scree::contact
