// The parts of the Python module, one function each.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include "engine/packing/packing.h"
#include "tools/scene/scene.h"

namespace scree::python {

// A scene and what it was read from, so that it can be read again with changes.
struct SceneSource {
  std::string file;  // absolute; or the folder that paths in the text are relative to
  std::string text;  // empty: of a file
  std::vector<std::string> overrides;
  Scene scene;
};

// A packing of either dimension, with its blocks in their places.
template <int dim>
struct PlacedPacking {
  packing::Packing<dim> packing;
  mesh::BlockMesh<dim> placed;
};
struct AnyPacking {
  std::variant<PlacedPacking<2>, PlacedPacking<3>> packing;
  std::string fall_key{};  // of the scene it was settled from; empty: it is from a file
};

// Gmsh and Bullet keep lengths for the whole process: only one thread at a time may mesh and settle. To be called without
// Python's lock.
std::unique_lock<std::mutex> alone();

// Of a text or of any other path that Python knows.
std::string file_name(const pybind11::object& path);

// Raises NotSettled with `packing` as its attribute.
[[noreturn]] void raise_not_settled(const std::vector<std::string>& reasons, const pybind11::object& packing);

// Lets Ctrl-C stop a long computation: called without Python's lock, takes it for a moment.
void check_signals();

void bind_errors(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_packing(pybind11::module_& module);
void bind_heating(pybind11::module_& module);
void bind_run(pybind11::module_& module);

}  // namespace scree::python
