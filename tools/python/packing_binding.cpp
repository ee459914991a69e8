#include <pybind11/stl.h>

#include "tools/library/make_packing.h"
#include "tools/python/bindings.h"
#include "tools/python/views.h"
#include "tools/run/keys.h"

namespace scree::python {

namespace py = pybind11;

namespace {

template <int dim>
AnyPacking with_places(packing::Packing<dim> packing, std::string fall_key = {}) {
  auto placed = packing::placed_mesh(packing);
  return {PlacedPacking<dim>{std::move(packing), std::move(placed)}, std::move(fall_key)};
}

AnyPacking made(const Scene& scene) {
  const py::gil_scoped_release others_may_run;
  const auto lock = alone();
  const auto progress = [](double) { check_signals(); };
  std::string key = scene.packing ? "" : run::fall_key(scene);
  if (scene.dimension == 2) return with_places(make_packing<2>(scene, progress), std::move(key));
  return with_places(make_packing<3>(scene, progress), std::move(key));
}

py::object settle(const SceneSource& source) {
  AnyPacking packing = made(source.scene);
  const auto faults = std::visit([&](const auto& any) { return faults_of(source.scene, any.packing); }, packing.packing);
  py::object result = py::cast(std::move(packing));
  if (!faults.empty()) raise_not_settled(faults, result);
  return result;
}

AnyPacking load(const py::object& path, int dimension) {
  const std::string file = file_name(path);
  if (dimension != 2 && dimension != 3) throw py::value_error("the dimension must be 2 or 3");
  if (dimension == 2) return with_places(packing::read<2>(file));
  return with_places(packing::read<3>(file));
}

py::array nodes(const py::object& self) {
  return std::visit(
      [&](const auto& any) {
        const auto& points = any.placed.nodes.raw();
        using Point = std::decay_t<decltype(points.front())>;
        const double* first = points.empty() ? nullptr : points.front().data();
        return view(first, points.size(), sizeof(Point), static_cast<std::size_t>(Point::RowsAtCompileTime), self);
      },
      self.cast<const AnyPacking&>().packing);
}

py::array elements(const py::object& self) {
  return std::visit(
      [&](const auto& any) {
        const auto& all = any.placed.elements.raw();
        using Element = std::decay_t<decltype(all.front())>;
        static_assert(sizeof(NodeId) == sizeof(std::int32_t));
        const auto* first = all.empty() ? nullptr : reinterpret_cast<const std::int32_t*>(all.front().data());
        return view(first, all.size(), sizeof(Element), std::tuple_size_v<Element>, self);
      },
      self.cast<const AnyPacking&>().packing);
}

py::array element_blocks(const AnyPacking& packing) {
  return std::visit(
      [](const auto& any) {
        std::vector<std::int32_t> blocks;
        for (const BlockId block : mesh::element_blocks(any.placed)) blocks.push_back(block.value());
        return own(std::move(blocks));
      },
      packing.packing);
}

std::size_t block_count(const AnyPacking& packing) {
  return std::visit([](const auto& any) { return any.placed.blocks.size(); }, packing.packing);
}

py::object report(const AnyPacking& packing) {
  const auto& settled = std::visit(
      [](const auto& any) -> const auto& { return any.packing.settled; }, packing.packing);
  if (!settled) return py::none();
  py::dict figures;
  figures["at_rest"] = settled->at_rest;
  figures["simulated_time"] = settled->simulated_time;
  figures["rms_speed"] = settled->rms_speed;
  figures["unbalanced_force"] = settled->unbalanced_force;
  figures["max_penetration"] = settled->max_penetration;
  figures["mean_edge"] = settled->mean_edge;
  figures["lost_blocks"] = settled->lost_blocks.size();
  figures["top"] = settled->top;
  return figures;
}

}  // namespace

void bind_packing(py::module_& module) {
  py::class_<AnyPacking>(module, "Packing", "Blocks at rest. Arrays look into its memory and are read-only.")
      .def_property_readonly("nodes", &nodes, "Where the nodes are, one row each [m].")
      .def_property_readonly("elements", &elements, "Nodes of every triangle or tetrahedron.")
      .def_property_readonly("element_blocks", &element_blocks, "Block of every element; a copy.")
      .def_property_readonly("block_count", &block_count, "How many blocks there are.")
      .def_property_readonly("report", &report, "What is known of the fall, by the names of summary.json; None without one.")
      .def(
          "save",
          [](const AnyPacking& packing, const py::object& file) {
            std::visit([&](const auto& any) { packing::write(any.packing, file_name(file)); }, packing.packing);
          },
          py::arg("file"), "Writes a packing file, for `packing:` in a scene and for `load_packing`.");
  module.def(
      "settle", &settle, py::arg("scene"),
      "Lets the blocks of a scene come to rest, in memory: they fall, or stay where they are placed, as the scene says. Raises "
      "NotSettled if they still move at settle.limit, unless the scene has settle.accept_moving.");
  module.def("load_packing", &load, py::arg("file"), py::arg("dimension") = 3, "Reads a packing file.");
}

}  // namespace scree::python
