// Everything a heated run writes at an output time, in an order that keeps the files consistent whenever the run ends.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "engine/output/series.h"
#include "thermal/heat_run.h"
#include "tools/run/heated_pile.h"
#include "tools/run/run_files.h"
#include "tools/scene/scene.h"

namespace scree::run {

template <int dim>
class HeatRecorder {
 public:
  // Starts the files, or goes on with those of a run that reached `resumed_from`.
  HeatRecorder(const Scene& scene, const RunFiles& files, const HeatedPile<dim>& pile, const thermal::HeatModel& model,
               std::optional<double> resumed_from);
  // Names the last frames and writes the restart file, if these are older than the frames: the run was stopped.
  ~HeatRecorder();
  HeatRecorder(const HeatRecorder&) = delete;
  HeatRecorder& operator=(const HeatRecorder&) = delete;

  // Adds the estimate of the space error to every frame from now on.
  void estimate_space_error() { space_error_ = true; }

  // Frames are written beside the computation; what goes wrong there is thrown by the next record() after it or by finish().
  void record(const thermal::HeatState& state);

  // Waits until everything is written.
  void finish();

 private:
  void write(thermal::HeatState state);
  // Names the frames in their .pvd, then writes the restart file, which never promises more than the other files hold. Both may
  // be some time behind the frames and the rows of the probes: a run that is killed computes that again.
  void save(const thermal::HeatState& state);
  void name_frames();
  void write_frame(const Eigen::VectorXd& temperature, const thermal::HeatState& state);

  const Scene& scene_;
  const HeatedPile<dim>& pile_;
  const thermal::HeatModel& model_;
  std::vector<output::Probe<dim>> probes_;  // of the model's rows
  std::filesystem::path restart_;
  bool several_threads_;
  output::Series series_;
  std::optional<output::Series> contact_series_;  // if there are contacts
  std::optional<output::ProbeTable> table_;
  bool space_error_ = false;
  std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();  // the last save()
  std::optional<thermal::HeatState> unsaved_;                                       // of the last frame
  std::future<void> pending_;  // goes first, so that it ends before what it uses
};

}  // namespace scree::run
