#include "contact/near_shells.h"

namespace scree::contact {

namespace {

template <int dim>
Aabb<dim> box_of(const Surface<dim>& surface, FaceId first, FaceId end, const ShellOptions& options) {
  Aabb<dim> box;
  for (std::size_t f = first.index(); f < end.index(); ++f) {
    for (const NodeId node : surface.faces[FaceId{f}].nodes) box.extend(surface.mesh.nodes[node]);
  }
  const double margin = widest_shift * options.indentation * box.diagonal().norm() + options.tolerance * surface.lengths[first];
  box.min().array() -= margin;
  box.max().array() += margin;
  return box;
}

}  // namespace

template <int dim>
ShellTable<dim> make_shells(const Surface<dim>& surface, const ShellOptions& options) {
  std::vector<FaceId> firsts = shell_starts(surface);
  const std::size_t count = firsts.size();
  firsts.emplace_back(surface.faces.size());
  LargeVector<Aabb<dim>> boxes(count);
  for_chunks(count, [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) boxes[i] = box_of(surface, firsts[i], firsts[i + 1], options);
  });
  ShellTable<dim> table{VectorWrittenLater<Shell<dim>>(count), BoxGrid<dim>(boxes)};
  // In the order of the mesh: writing here and there waits for nothing, reading does.
  VectorWrittenLater<std::uint32_t> places(count);
  for (std::uint32_t place = 0; place < count; ++place) places[table.grid.order()[place]] = place;
  for_chunks(count, [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      table.shells[places[i]] = make_shell(surface, firsts[i], firsts[i + 1], options);
    }
  });
  return table;
}

template ShellTable<2> make_shells<2>(const Surface<2>&, const ShellOptions&);
template ShellTable<3> make_shells<3>(const Surface<3>&, const ShellOptions&);

}  // namespace scree::contact
