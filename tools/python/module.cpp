#include "tools/python/bindings.h"

#include <pthread.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pybind11/numpy.h>

#include "engine/base/check.h"
#include "engine/base/threads.h"
#include "engine/base/version.h"

namespace scree::python {

namespace py = pybind11;

std::unique_lock<std::mutex> alone() {
  static std::mutex one_at_a_time;
  return std::unique_lock(one_at_a_time);
}

void check_signals() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void bind_errors(py::module_& module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
      "What a scene or a file says is wrong: one line for everything that is, with place, key, value and rule.";
  py::register_exception<RunError>(module, "RunError", PyExc_RuntimeError).doc() =
      "A computation that could not go on although its input was accepted.";
  const auto not_settled = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc("scree.NotSettled",
                                "A fall whose blocks still move at its end, or overlap too far. Its attribute `packing` is "
                                "the packing nevertheless.",
                                module.attr("RunError").ptr(), nullptr));
  module.attr("NotSettled") = not_settled;
}

void raise_not_settled(const std::vector<std::string>& reasons, const py::object& packing) {
  const py::object type = py::module_::import("scree").attr("NotSettled");
  const py::object error = type(fmt::format("{}", fmt::join(reasons, "; ")));
  error.attr("packing") = packing;
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

}  // namespace scree::python

PYBIND11_MODULE(scree, module) {
  namespace py = pybind11;
  module.doc() = "Heat in heaps: settle piles of blocks and heat them. SI units, temperatures in kelvin.";
  module.attr("__version__") = scree::version();
  module.def(
      "use_threads",
      [](int count) {
        if (count < 1 || count > 1024) throw py::value_error("the number of threads must be 1 to 1024");
        scree::use_threads(count);
      },
      py::arg("count"),
      "What this thread of Python calls from here on computes with so many threads. No result depends on it.");
  // Threads that make their first array at the same time would wait for each other for ever.
  py::detail::npy_api::get();
  // The threads of OpenMP do not come along, and it would wait for them.
  pthread_atfork(nullptr, nullptr, [] { scree::use_threads(1); });
  scree::python::bind_errors(module);
  scree::python::bind_scene(module);
  scree::python::bind_packing(module);
  scree::python::bind_heating(module);
  scree::python::bind_run(module);
}
