#include "tools/study/conductor.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "engine/base/threads.h"
#include "tools/run/forget_run.h"
#include "tools/run/interrupt.h"
#include "tools/study/outcome.h"
#include "tools/study/packings.h"

namespace scree::study {

namespace {

namespace fs = std::filesystem;

constexpr auto pause = std::chrono::milliseconds(20);  // between two looks at the runs
constexpr double reserve = 1.1;                        // memory kept for a run over the largest so far

}  // namespace

Conductor::Conductor(const Study& study, StudyFiles files, const Means& means, Progress& progress,
                     std::function<void()> after_each)
    : study_(study), files_(std::move(files)), means_(means), progress_(progress), after_each_(std::move(after_each)) {}

void Conductor::make(const std::vector<PlannedRun>& runs) {
  choose(runs);
  show("");
  try {
    while (!waiting_.empty() || !active_.empty()) {
      run::check_interrupt();
      start_what_can();
      collect();
      std::this_thread::sleep_for(pause);
    }
  } catch (...) {
    stop_all();
    throw;
  }
}

// Equal runs are made once; those with a final result are not made again.
void Conductor::choose(const std::vector<PlannedRun>& runs) {
  std::set<std::string> chosen;
  std::set<std::string> packings;
  for (const PlannedRun& run : runs) {
    if (!chosen.insert(run.directory).second) continue;
    ++all_;
    const Outcome outcome = read_outcome(files_, run.directory);
    largest_run_ = std::max(largest_run_, outcome.peak_memory_bytes);
    if (outcome.is_final()) {
      ++done_;
      failed_ += outcome.status == "complete" ? 0 : 1;
    } else {
      waiting_.push_back(&run);
      const bool settles =
          !run.packing.empty() && !fs::exists(files_.packing(run.packing)) && packings.insert(run.packing).second;
      if (settles) settling_runs_.insert(&run);
      forecast_.expect(settles);
    }
  }
}

void Conductor::start_what_can() {
  for (std::size_t i = 0; i < waiting_.size() && has_room();) {
    if (try_start(*waiting_[i])) {
      waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

// The first run is alone: it tells how much memory the others will want, and takes all processors meanwhile.
bool Conductor::has_room() const {
  if (active_.empty()) return true;
  if (largest_run_ == 0 || static_cast<int>(active_.size()) >= means_.jobs) return false;
  return reserve * largest_run_ * static_cast<double>(active_.size() + 1) <= static_cast<double>(means_.memory);
}

// True if the run need not wait any more: it was started, or cannot be.
bool Conductor::try_start(const PlannedRun& run) {
  const fs::path packing = files_.packing(run.packing);
  if (run.packing.empty() || fs::exists(packing)) {
    start(run, std::nullopt);
    return true;
  }
  if (const auto failure = failed_packings_.find(run.packing); failure != failed_packings_.end()) {
    write_refusal(files_, run.directory, failure->second);
    forecast_.count(false, 0);
    ++done_;
    ++failed_;
    after_each_();
    return true;
  }
  auto lock = run::FileLock::take(files_.packing_lock(run.packing), run::FileLock::Kind::exclusive, run::FileLock::Heirs::none);
  if (!lock) return false;
  // Somebody may have put it there just now.
  if (fs::exists(packing)) lock.reset();
  start(run, std::move(lock));
  return true;
}

void Conductor::start(const PlannedRun& run, std::optional<run::FileLock> settling) {
  const run::RunFiles own = files_.run(run.directory);
  fs::create_directories(own.directory);
  fs::remove(files_.outcome(run.directory));
  if (!run.packing.empty() && !settling) take_packing(files_, run);
  const bool resumes = fs::exists(own.scene());  // a run that was begun goes on with the scene it has
  active_.push_back(
      {&run, resumes, run::ChildProcess(command_of(run, resumes), files_.log(run.directory)), std::move(settling)});
}

std::vector<std::string> Conductor::command_of(const PlannedRun& run, bool resumes) const {
  const run::RunFiles own = files_.run(run.directory);
  std::vector<std::string> words;
  if (resumes) {
    words = {"resume", own.directory.string()};
  } else {
    words = {"run", study_.scene.string(), "--out", own.directory.string(), "--planned", run.directory};
    for (const std::string& assignment : run.overrides) words.insert(words.end(), {"--set", assignment});
  }
  const int sharing = largest_run_ == 0 ? 1 : means_.jobs;
  const int threads = means_.threads.value_or(std::max(1, available_processors() / sharing));
  words.insert(words.end(), {"--quiet", "--threads", fmt::format("{}", threads)});
  if (study_.error_estimate) words.emplace_back("--error-estimate");
  return words;
}

void Conductor::collect() {
  for (std::size_t i = 0; i < active_.size();) {
    const auto end = active_[i].process.poll();
    // As soon as the run has written its packing, and before its own heat.
    if (active_[i].settling && publish_packing(files_, *active_[i].run)) active_[i].settling.reset();
    if (end) {
      Active ended = std::move(active_[i]);
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
      finish(ended, *end);
    } else {
      ++i;
    }
  }
}

void Conductor::finish(Active& active, const run::ChildEnd& end) {
  const PlannedRun& run = *active.run;
  write_outcome(files_, run.directory, end);
  if (active.resumed && end.exit_status == 2) return begin_anew(run);
  const Outcome outcome = read_outcome(files_, run.directory);
  largest_run_ = std::max(largest_run_, outcome.peak_memory_bytes);
  // What ended a process from outside need not end the next one, nor what is wrong with this run's own values.
  const bool ended_from_outside = outcome.status == "crashed" || outcome.status == "interrupted";
  if (active.settling && !ended_from_outside && outcome.status != "bad_input") {
    failed_packings_[run.packing] =
        fmt::format("its packing is that of run {}, which has none: {}", run.number, outcome.reason);
  }
  forecast_.count(settling_runs_.contains(&run), end.wall_seconds);
  ++done_;
  const bool sound = outcome.status == "complete";
  failed_ += sound ? 0 : 1;
  after_each_();
  show(sound ? "" : fmt::format("run {} {}: {}", run.number, outcome.status, outcome.reason));
}

// What cannot be gone on with, such as a state that is damaged.
void Conductor::begin_anew(const PlannedRun& run) {
  const std::string reason = read_outcome(files_, run.directory).reason;
  run::forget_run(files_.run(run.directory));
  waiting_.push_back(&run);
  show(fmt::format("run {} is begun anew: {}", run.number, reason));
}

void Conductor::stop_all() {
  for (const Active& active : active_) active.process.interrupt();
  for (Active& active : active_) {
    const run::ChildEnd end = active.process.wait();
    try {
      write_outcome(files_, active.run->directory, end);
    } catch (const std::exception&) {
      // The study ends for a reason that is told, as a full disk, which leaves no room for this either. All are waited for.
    }
  }
  active_.clear();
}

void Conductor::show(const std::string& event) {
  if (!event.empty()) progress_.note(event);
  progress_.update(forecast_.done_part(),
                   fmt::format("{} of {} runs{}", done_, all_, failed_ == 0 ? "" : fmt::format(", {} failed", failed_)));
}

}  // namespace scree::study
