#include "tools/run/frames.h"

#include <algorithm>
#include <numeric>

#include "engine/mesh/cells.h"

namespace scree::run {

namespace {

template <class Contacts, class Get>
auto collect(const Contacts& contacts, Get get) {
  std::vector<decltype(get(contacts.front()))> values;
  values.reserve(contacts.size());
  for (const auto& contact : contacts) values.push_back(get(contact));
  return values;
}

}  // namespace

template <int dim>
std::vector<output::Array> identity_arrays(const mesh::BlockMesh<dim>& mesh, const Table<BlockId, BlockId>& numbers) {
  std::vector<std::int32_t> blocks, bodies, materials;
  for (const BlockId id : mesh.blocks.ids()) {
    const mesh::Block& block = mesh.blocks[id];
    const std::size_t shown = block.cells.size() > 0 ? block.cells.size() : block.elements.size();
    blocks.insert(blocks.end(), shown, numbers[id].value());
    bodies.insert(bodies.end(), shown, block.body.value());
    materials.insert(materials.end(), shown, mesh.bodies[block.body].material.value());
  }
  return {{"block", 1, std::move(blocks)}, {"body", 1, std::move(bodies)}, {"material", 1, std::move(materials)}};
}

output::Grid grid_at(const mesh::BlockMesh<3>& mesh, const Table<BlockId, Pose>& poses) {
  output::Grid grid = output::make_grid(mesh);
  for (const BlockId block : mesh.blocks.ids()) {
    for (const NodeId node : mesh.blocks[block].nodes) grid.points[node.index()] = poses[block] * grid.points[node.index()];
  }
  grid.to_look_at = true;
  return grid;
}

template <int dim>
output::Frame heat_frame(double time, const Eigen::VectorXd& temperature, const std::vector<Point<dim>>& flux) {
  std::vector<float> components(3 * flux.size());
  auto at = components.begin();
  for (const Point<dim>& q : flux) at = std::copy(q.begin(), q.end(), at) + (3 - dim);
  output::Frame frame{time, {}, {}};
  frame.points.push_back({"temperature", 1, std::vector<double>(temperature.begin(), temperature.end())});
  frame.cells.push_back({"heat_flux", 3, std::move(components)});
  return frame;
}

// Of what series show: cells in their order, or elements, of each block.
template <int dim>
std::vector<double> largest_in_cells(const mesh::BlockMesh<dim>& mesh, const std::vector<double>& of_element) {
  if (mesh.cells.empty()) return of_element;
  const mesh::CellOfElement<dim> cells(mesh);
  std::vector<double> largest;
  CellId last;
  for (const ElementId element : mesh.elements.ids()) {
    const double value = of_element[element.index()];
    if (cells[element].valid() && cells[element] == last) {
      largest.back() = std::max(largest.back(), value);
    } else {
      largest.push_back(value);
    }
    last = cells[element];
  }
  return largest;
}

template <int dim>
output::Grid contact_grid(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts) {
  output::Grid grid;
  grid.to_look_at = true;
  for (const auto& contact : contacts.contacts) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<dim>() = contact::point_of(mesh, contact);
    grid.points.push_back(point);
  }
  grid.types.assign(grid.points.size(), output::CellType::vertex);
  grid.connectivity.resize(grid.points.size());
  std::iota(grid.connectivity.begin(), grid.connectivity.end(), 0);
  return grid;
}

template <int dim>
std::vector<output::Array> contact_arrays(const contact::ContactSet<dim>& contacts, const Table<BlockId, BlockId>& numbers) {
  using Contact = contact::Contact<dim>;
  const auto& all = contacts.contacts;
  return {{"area", 1, collect(all, [](const Contact& c) { return static_cast<float>(c.area); })},
          {"gap", 1, collect(all, [](const Contact& c) { return static_cast<float>(c.gap); })},
          {"kind", 1, collect(all, [](const Contact& c) { return static_cast<std::int32_t>(c.kind); })},
          {"owner", 1, collect(all, [&](const Contact& c) { return numbers[c.owner].value(); })},
          {"target", 1, collect(all, [&](const Contact& c) { return numbers[c.target].value(); })}};
}

#define SCREE_INSTANTIATE(dim)                                                                                           \
  template std::vector<output::Array> identity_arrays<dim>(const mesh::BlockMesh<dim>&, const Table<BlockId, BlockId>&); \
  template output::Frame heat_frame<dim>(double, const Eigen::VectorXd&, const std::vector<Point<dim>>&);                \
  template std::vector<double> largest_in_cells<dim>(const mesh::BlockMesh<dim>&, const std::vector<double>&);           \
  template output::Grid contact_grid<dim>(const mesh::BlockMesh<dim>&, const contact::ContactSet<dim>&);                 \
  template std::vector<output::Array> contact_arrays<dim>(const contact::ContactSet<dim>&, const Table<BlockId, BlockId>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::run
