#include <csignal>

#include "tools/python/bindings.h"
#include "tools/run/run_scene.h"

namespace scree::python {

namespace py = pybind11;

namespace {

// A run remembers signals in a way of its own; afterwards they are Python's again.
class KeptHandler {
 public:
  explicit KeptHandler(int signal) : signal_(signal) { ::sigaction(signal, nullptr, &before_); }
  ~KeptHandler() { ::sigaction(signal_, &before_, nullptr); }
  KeptHandler(const KeptHandler&) = delete;
  KeptHandler& operator=(const KeptHandler&) = delete;

 private:
  int signal_;
  struct sigaction before_ {};
};

py::object run(const SceneSource& source, const py::object& out, bool error_estimate) {
  const run::RunFiles files{file_name(out)};
  {
    const py::gil_scoped_release others_may_run;
    const auto lock = alone();
    const KeptHandler keeps_ctrl_c(SIGINT);
    const KeptHandler keeps_termination(SIGTERM);
    Progress progress(ProgressMode::quiet);
    run::run_scene(source.scene, files, run::Start::fresh, progress,
                   error_estimate ? run::SpaceErrors::estimated : run::SpaceErrors::left_out);
  }
  const py::object text = py::module_::import("pathlib").attr("Path")(files.summary().string()).attr("read_text")("utf-8");
  py::object summary = py::module_::import("json").attr("loads")(text);
  if (summary["status"].cast<std::string>() == "interrupted") {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return summary;
}

}  // namespace

void bind_run(py::module_& module) {
  module.def("run", &run, py::arg("scene"), py::arg("out"), py::arg("error_estimate") = false,
             "What `scree run` does: the whole run with its files in the folder `out`. Gives summary.json as a dict; its "
             "'status' says how the run ended. Raises InputError for a scene that is refused before any work. Uses the packing "
             "that is there if nothing it depends on has changed.");
}

}  // namespace scree::python
