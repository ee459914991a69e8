#include <pybind11/stl.h>

#include <filesystem>

#include <fmt/format.h>

#include "tools/python/bindings.h"
#include "tools/scene/read_scene.h"

namespace scree::python {

namespace py = pybind11;

namespace {

// What json does not know: paths, and the numbers and arrays of numpy.
py::object plain(const py::object& value) {
  if (py::hasattr(value, "__fspath__")) return py::module_::import("os").attr("fspath")(value);
  if (py::hasattr(value, "tolist")) {
    py::object list = value.attr("tolist")();
    // Of a number that Python has no type for, as numpy's long double, it is the same again.
    return py::type::of(list).is(py::type::of(value)) ? py::float_(list) : list;
  }
  throw py::type_error(fmt::format("a scene has no place for a {}", py::repr(py::type::of(value)).cast<std::string>()));
}

// A Python value as a scene file would have it. JSON is YAML: a text stays the text it is.
std::string as_yaml(const py::handle& value) {
  const py::object dumps = py::module_::import("json").attr("dumps");
  return dumps(value, py::arg("ensure_ascii") = false, py::arg("default") = py::cpp_function(&plain)).cast<std::string>();
}

// Of any mapping.
std::vector<std::string> overrides_of(const py::object& changes) {
  std::vector<std::string> overrides;
  for (const auto& [key, value] : py::dict(changes)) {
    if (!py::isinstance<py::str>(key)) {
      throw py::type_error(fmt::format("a key of a scene must be a text, not {}", py::repr(key).cast<std::string>()));
    }
    overrides.push_back(fmt::format("{}={}", key.cast<std::string>(), as_yaml(value)));
  }
  return overrides;
}

SceneSource read(SceneSource source) {
  source.scene = source.text.empty() ? read_scene(source.file, source.overrides)
                                     : read_scene_text(source.text, source.file, source.overrides);
  return source;
}

SceneSource changed(const SceneSource& source, const py::object& changes) {
  SceneSource other = source;
  for (std::string& assignment : overrides_of(changes)) other.overrides.push_back(std::move(assignment));
  return read(std::move(other));
}

std::vector<std::string> body_names(const SceneSource& source) {
  std::vector<std::string> names;
  for (const mesh::BodySpec& body : source.scene.bodies) names.push_back(body.name);
  return names;
}

std::vector<std::string> probe_names(const SceneSource& source) {
  std::vector<std::string> names;
  for (const output::ProbeSpec& probe : source.scene.probes) names.push_back(probe.name);
  return names;
}

// `changed` reads the file again, wherever the program has gone meanwhile.
std::string absolute_name(const py::object& path) {
  return std::filesystem::absolute(file_name(path)).string();
}

}  // namespace

std::string file_name(const py::object& path) {
  auto name = py::module_::import("os").attr("fspath")(path).cast<std::string>();
  if (name.empty()) throw py::value_error("a name of a file or folder must not be empty");
  return name;
}

void bind_scene(py::module_& module) {
  py::class_<SceneSource>(module, "Scene",
                          "A scene, checked. It never changes: `changed` gives another. `scree keys` prints every key.")
      .def(py::init([](const py::object& file, const py::object& changes) {
             return read({absolute_name(file), "", overrides_of(changes), {}});
           }),
           py::arg("file"), py::arg("changes") = py::dict(),
           "Reads a scene file, with changes such as {'heat.until': '2 h', 'contact.stiffness_factor': 100}.")
      .def_static(
          "from_text",
          [](const std::string& text, const py::object& changes, const py::object& folder) {
            // An empty text would stand for a file.
            return read({absolute_name(folder), text.empty() ? "\n" : text, overrides_of(changes), {}});
          },
          py::arg("text"), py::arg("changes") = py::dict(), py::arg("folder") = ".",
          "A scene from its YAML text; paths in it are relative to the folder.")
      .def("changed", &changed, py::arg("changes"),
           "The same scene with other values; None takes a key away. Raises InputError for what does not suit.")
      .def_property_readonly(
          "title", [](const SceneSource& source) { return source.scene.title; }, "What the scene shows.")
      .def_property_readonly(
          "dimension", [](const SceneSource& source) { return source.scene.dimension; }, "2 or 3.")
      .def_property_readonly("bodies", &body_names, "Names of the bodies, in the scene's order.")
      .def_property_readonly("probes", &probe_names, "Names of the probes.")
      .def_property_readonly(
          "effective", [](const SceneSource& source) { return source.scene.effective; },
          "The scene as YAML with every default filled in.");
}

}  // namespace scree::python
