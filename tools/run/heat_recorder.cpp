#include "tools/run/heat_recorder.h"

#include <utility>

#include "engine/base/threads.h"
#include "thermal/fluxes.h"
#include "thermal/space_error.h"
#include "tools/run/frames.h"

namespace scree::run {

namespace {

template <int dim>
output::ProbeTable open_table(const RunFiles& files, const HeatedPile<dim>& pile, std::optional<double> resumed_from) {
  const auto comments = output::describe(pile.probes, pile.mesh, pile.places.blocks);
  const auto columns = output::columns(pile.probes);
  return resumed_from ? output::ProbeTable(files.probes(), comments, columns, *resumed_from)
                      : output::ProbeTable(files.probes(), comments, columns);
}

// Of wall time that a run which is killed may have to compute again. Short runs write many frames in a second, and to write
// the restart file takes as long as a frame of temperatures.
constexpr std::chrono::seconds longest_unsaved{1};

// And one that is told to stop: to copy a state takes little of that.
constexpr std::chrono::milliseconds longest_unkept{100};

// Files that wait for others to be flushed with them. Flushing them all takes as long as flushing one.
constexpr std::chrono::milliseconds longest_unflushed{50};

// Temperatures of outputs that a step has passed, for frames: more are not kept in memory.
constexpr double most_bytes_waiting = 64e6;

// The same probes, that read the rows of a model instead of the nodes of its mesh.
template <int dim>
std::vector<output::Probe<dim>> probes_of_rows(std::vector<output::Probe<dim>> probes, const thermal::NodeMap& rows) {
  for (output::Probe<dim>& probe : probes) {
    for (NodeId& node : probe.reading.nodes) node = rows[node];
  }
  return probes;
}

// Calls both, at the same time if there are threads for it.
template <class First, class Second>
void call_both(bool at_once, const First& first, const Second& second) {
  auto other = std::async(at_once ? std::launch::async : std::launch::deferred, [&] {
    if (at_once) use_threads(1);  // of that thread's own loops
    second();
  });
  first();
  other.get();
}

}  // namespace

template <int dim>
HeatRecorder<dim>::HeatRecorder(const Scene& scene, const RunFiles& files, const HeatedPile<dim>& pile,
                                const thermal::HeatModel& model, std::optional<double> resumed_from)
    : scene_(scene),
      pile_(pile),
      model_(model),
      probes_(probes_of_rows(pile.probes, model.rows)),
      restart_(files.restart()),
      several_threads_(threads_in_use() > 1),
      frame_times_(scene),
      series_(files.directory, heat_series, last_frame(resumed_from)) {
  const auto& numbers = pile.places.blocks;
  const auto share_blocks = [&] { series_.share(output::make_grid(pile.mesh), identity_arrays(pile.mesh, numbers)); };
  const auto share_contacts = [&] {
    if (pile.contacts.contacts.empty()) return;
    contact_series_.emplace(files.directory, contact_series, last_frame(resumed_from));
    contact_series_->share(contact_grid(pile.mesh, pile.contacts), contact_arrays(pile.contacts, numbers));
  };
  call_both(several_threads_, share_blocks, share_contacts);
  if (!pile.probes.empty()) table_.emplace(open_table(files, pile, resumed_from));
}

template <int dim>
std::optional<double> HeatRecorder<dim>::last_frame(std::optional<double> resumed_from) const {
  return resumed_from ? std::optional(frame_times_.last(*resumed_from)) : std::nullopt;
}

// What stops the run is told by whoever stops it, and an older restart file stays what it is.
template <int dim>
HeatRecorder<dim>::~HeatRecorder() {
  try {
    if (pending_.valid()) pending_.wait();
    publish(files_);
    if (unsaved_) save(*unsaved_);
  } catch (...) {
  }
}

template <int dim>
void HeatRecorder<dim>::record(const thermal::HeatState& state) {
  add_row(state.time, state.temperature);
  const bool frame = frame_times_.due(state.time);
  const auto now = std::chrono::steady_clock::now();
  if (frame || now - kept_ >= longest_unkept) {
    kept_ = now;
    waiting_.push_back([this, frame, kept = std::make_shared<const thermal::HeatState>(state)](bool beside) {
      if (frame) write_frame(kept->time, kept->temperature, beside);
      keep(kept);
    });
  }
  if (state.time < scene_.heat->time.until) write_beside();
}

template <int dim>
void HeatRecorder<dim>::record_passed(double time, const Eigen::VectorXd& temperature) {
  add_row(time, temperature);
  if (!frame_times_.due(time)) return;
  waiting_.push_back([this, time, temperature](bool beside) { write_frame(time, temperature, beside); });
  if (static_cast<double>(waiting_.size() * temperature.size() * sizeof(double)) > most_bytes_waiting) write_beside();
}

// Beside frames that are being written: a row takes less than to start a thread.
template <int dim>
void HeatRecorder<dim>::add_row(double time, const Eigen::VectorXd& temperature) {
  if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) wait_for_others();
  if (table_) table_->append(time, output::column_values(probes_, temperature, time));
}

template <int dim>
void HeatRecorder<dim>::write_beside() {
  if (waiting_.empty()) return;
  wait_for_others();
  pending_ = std::async(std::launch::async, [this, frames = std::exchange(waiting_, {})] {
    use_threads(1);  // of this thread's own loops
    write_all(frames, true, files_);
    publish_in_time();
  });
}

// Unless somebody waits: then what is written next goes with these files.
template <int dim>
void HeatRecorder<dim>::publish_in_time() {
  const auto now = std::chrono::steady_clock::now();
  const auto due = files_.since().value_or(now) + longest_unflushed;
  if (now >= due || !others_wait_.try_acquire_until(due)) publish(files_);
}

template <int dim>
void HeatRecorder<dim>::write_all(const Frames& frames, bool beside, FilesTogether& files) {
  const FilesTogether::Scope scope(files);
  try {
    for (const auto& write : frames) write(beside);
  } catch (...) {
    publish(files);  // what came before
    throw;
  }
}

// Frames that are lost must not be named when the run ends.
template <int dim>
void HeatRecorder<dim>::publish(FilesTogether& files) {
  try {
    files.publish();
  } catch (...) {
    unsaved_.reset();
    throw;
  }
}

template <int dim>
void HeatRecorder<dim>::wait_for_others() {
  if (!pending_.valid()) return;
  others_wait_.release();
  pending_.wait();
  static_cast<void>(others_wait_.try_acquire());  // it may not have asked
  pending_.get();
}

template <int dim>
void HeatRecorder<dim>::finish(FilesTogether& last) {
  wait_for_others();
  files_.pass_on(last);
  write_all(std::exchange(waiting_, {}), false, last);
}

template <int dim>
void HeatRecorder<dim>::keep(std::shared_ptr<const thermal::HeatState> state) {
  if (state->time == 0) {  // a run that starts has nothing to go on from, least of all an earlier run's state
    std::filesystem::remove(restart_);
    name_frames();
  } else if (state->time >= scene_.heat->time.until || std::chrono::steady_clock::now() - saved_ >= longest_unsaved) {
    save(*state);
  } else {
    unsaved_ = std::move(state);
  }
}

template <int dim>
void HeatRecorder<dim>::save(const thermal::HeatState& state) {
  name_frames();
  thermal::write(state, pile_.key, restart_);
  unsaved_.reset();
  saved_ = std::chrono::steady_clock::now();
}

template <int dim>
void HeatRecorder<dim>::name_frames() {
  series_.name_frames();
  if (contact_series_) contact_series_->name_frames();
}

template <int dim>
void HeatRecorder<dim>::write_frame(double time, const Eigen::VectorXd& of_rows, bool beside) {
  const Eigen::VectorXd temperature = model_.rows.to_nodes(of_rows);
  const auto write_blocks = [&] {
    const auto flux = thermal::cell_fluxes(pile_.mesh, scene_.materials, temperature);
    output::Frame frame = heat_frame<dim>(time, temperature, flux);
    if (space_error_) {
      const auto rate = model_.rows.to_nodes(thermal::temperature_rate(model_, of_rows, time));
      const auto error = thermal::estimate_space_error(pile_.mesh, scene_.materials, temperature, rate);
      frame.cells.push_back({"space_error", 1, largest_in_cells(pile_.mesh, error.of_element)});
    }
    series_.add(frame);
  };
  const auto write_contacts = [&] {
    if (!contact_series_) return;
    const auto flows = thermal::contact_flows(pile_.contacts, pile_.joints, temperature, scene_.heat->joint.form);
    contact_series_->add({time, {}, {{"heat_flow", 1, std::vector<float>(flows.begin(), flows.end())}}});
  };
  call_both(several_threads_ && !beside, write_blocks, write_contacts);
}

template class HeatRecorder<2>;
template class HeatRecorder<3>;

}  // namespace scree::run
