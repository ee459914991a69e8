// Everything a heated run writes at an output time, in an order that keeps the files consistent whenever the run ends.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <semaphore>
#include <string>
#include <vector>

#include "engine/base/files_together.h"
#include "engine/output/series.h"
#include "thermal/heat_run.h"
#include "tools/run/frame_times.h"
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
  // Names the last frames and writes the restart file, if that is older than the last state kept: the run was stopped.
  ~HeatRecorder();
  HeatRecorder(const HeatRecorder&) = delete;
  HeatRecorder& operator=(const HeatRecorder&) = delete;

  // Adds the estimate of the space error to every frame from now on.
  void estimate_space_error() { space_error_ = true; }

  // At an output from whose state the run can go on. Its frame and those passed before are written beside the computation, the
  // last by finish(); what goes wrong there is thrown by the next record() after it or by finish().
  void record(const thermal::HeatState& state);
  // At another.
  void record_passed(double time, const Eigen::VectorXd& temperature);

  // Files that are to have their names before the first frame has.
  void publish_before_frames(FilesTogether& files) { files.pass_on(files_); }

  // Writes the last frame and waits until everything is written; what there is of it yet to be flushed waits in `last`.
  void finish(FilesTogether& last);

 private:
  // What writes each. `beside`: whether the run goes on meanwhile.
  using Frames = std::vector<std::function<void(bool beside)>>;

  void add_row(double time, const Eigen::VectorXd& temperature);
  // The frames that wait, in a thread of their own, when those before are written.
  void write_beside();
  void wait_for_others();
  void write_all(const Frames& frames, bool beside, FilesTogether& files);
  void publish_in_time();
  void publish(FilesTogether& files);
  void keep(std::shared_ptr<const thermal::HeatState> state);
  // Names the frames in their .pvd, then writes the restart file, which never promises more than the other files hold. Both may
  // be some time behind the frames and the rows of the probes: a run that is killed computes that again.
  void save(const thermal::HeatState& state);
  void name_frames();
  [[nodiscard]] std::optional<double> last_frame(std::optional<double> resumed_from) const;
  void write_frame(double time, const Eigen::VectorXd& of_rows, bool beside);

  const Scene& scene_;
  const HeatedPile<dim>& pile_;
  const thermal::HeatModel& model_;
  std::vector<output::Probe<dim>> probes_;  // of the model's rows
  std::filesystem::path restart_;
  bool several_threads_;
  FrameTimes frame_times_;
  output::Series series_;
  std::optional<output::Series> contact_series_;  // if there are contacts
  std::optional<output::ProbeTable> table_;
  bool space_error_ = false;
  std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();  // the last save()
  std::chrono::steady_clock::time_point kept_ = saved_;                             // the last copy of a state
  std::shared_ptr<const thermal::HeatState> unsaved_;                               // the last of those that are kept
  Frames waiting_;                                                                  // frames that no thread writes yet
  FilesTogether files_;                                                             // that are yet to be flushed
  std::binary_semaphore others_wait_{0};                                            // for the thread that writes frames
  std::future<void> pending_;  // goes first, so that it ends before what it uses
};

}  // namespace scree::run
