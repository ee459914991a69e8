#include "tools/accuracy/accuracy_command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/progress.h"
#include "engine/base/units.h"
#include "tools/accuracy/analysis.h"
#include "tools/accuracy/report.h"
#include "tools/run/child_process.h"
#include "tools/run/file_lock.h"
#include "tools/run/forget_run.h"
#include "tools/run/interrupt.h"
#include "tools/run/output_place.h"
#include "tools/run/run_files.h"
#include "tools/scene/read_scene.h"

namespace scree::accuracy {

namespace {

using run::RunFiles;
namespace fs = std::filesystem;

constexpr const char* table_name = "accuracy.csv";
constexpr const char* picture_name = "accuracy.png";
constexpr const char* lock_name = ".lock";

double kelvin_difference(const std::string& text) {
  const auto parsed = parse_quantity(text, quantity::temperature_difference);
  if (const auto* number = std::get_if<double>(&parsed); number != nullptr && *number > 0) return *number;
  Problem problem;
  problem.key = "--tolerance";
  problem.value = text;
  problem.rule = "must be a positive temperature difference, such as \"0.1 K\"";
  throw InputError(problem);
}

void check_scene(const Scene& scene) {
  if (scene.heat && !scene.probes.empty()) return;
  Problem problem;
  problem.where.file = scene.file.string();
  problem.key = "output.probes";
  problem.value = scene.heat ? "empty" : "without heat";
  problem.rule = "must name at least one point, since errors are compared at the probes";
  throw InputError(problem);
}

// The figures of a run from its summary; a run that left none keeps zeros.
void read_summary(const RunFiles& files, Measured& measured) {
  std::ifstream stream(files.summary());
  const auto summary = nlohmann::json::parse(stream, nullptr, false);
  if (summary.is_discarded() || !summary.contains("heat")) return;
  measured.ran = true;
  measured.nodes = summary.at("nodes");
  measured.elements = summary.at("elements");
  measured.steps = summary.at("heat").value("steps", std::int64_t{0});
  measured.time_error = summary.at("heat").value("time_error", 0.0);
  if (summary.at("heat").contains("lumped_blocks")) measured.lumping_error = summary.at("heat").at("lumped_blocks").at("error");
  for (const auto& stage : summary.at("stages")) {
    const std::string name = stage.at("name");
    if (name == "contacts" || name == "assemble" || name == "heat")
      measured.wall_seconds += stage.at("wall_seconds").get<double>();
    measured.peak_memory_bytes = std::max(measured.peak_memory_bytes, stage.at("peak_memory_bytes").get<double>());
  }
}

// Throws run::Interrupted when Ctrl-C or SIGTERM has come and ended the run.
run::ChildEnd wait_for(run::ChildProcess process) {
  constexpr auto pause = std::chrono::milliseconds(5);
  std::optional<run::ChildEnd> end;
  try {
    while (!(end = process.poll())) {
      run::check_interrupt();
      std::this_thread::sleep_for(pause);
    }
  } catch (const run::Interrupted&) {
    process.interrupt();
    process.wait();
    throw;
  }
  constexpr int by_signal = 128;
  if (end->exit_status > by_signal) run::check_interrupt();
  return *end;
}

class Study {
 public:
  Study(const Arguments& arguments, const Scene& scene, fs::path directory)
      : arguments_(arguments), scene_(scene), directory_(std::move(directory)) {}

  // Every run starts from the packing of the first, if the blocks fall.
  [[nodiscard]] Measured make(const Rung& rung, std::size_t number) const {
    const RunFiles files{run_directory(number)};
    fs::create_directories(files.directory);
    // Of an earlier call: a run that is refused leaves it.
    if (fs::exists(files.summary())) {
      refuse_foreign(files);
      run::forget_run(files);
    }
    const RunFiles first{run_directory(0)};
    if (number > 0 && scene_.settle && fs::exists(first.packing())) {
      fs::copy_file(first.packing(), files.packing(), fs::copy_options::overwrite_existing);
    }
    std::vector<std::string> words{"run", fs::absolute(scene_.file).string(), "--quiet", "--out", files.directory.string()};
    if (arguments_.threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", arguments_.threads)});
    for (const auto& overrides : {arguments_.overrides, overrides_of(scene_, rung)}) {
      for (const std::string& assignment : overrides) words.insert(words.end(), {"--set", assignment});
    }
    const run::ChildEnd child = wait_for(run::ChildProcess(words, log_of(files)));
    Measured measured;
    measured.rung = rung;
    measured.exit_status = child.exit_status;
    measured.whole_wall_seconds = child.wall_seconds;
    read_summary(files, measured);
    return measured;
  }

  // What each run of this command has printed stands beside its results.
  static void refuse_foreign(const RunFiles& files) {
    if (fs::exists(log_of(files))) return;
    Problem problem;
    problem.key = "--out";
    problem.value = files.directory.string();
    problem.rule = "must not be a run that this command has not made: it would be removed";
    throw InputError(problem);
  }

  static fs::path log_of(const RunFiles& files) { return files.directory / "log"; }

  [[nodiscard]] fs::path run_directory(std::size_t number) const { return directory_ / fmt::format("run_{:02}", number); }

 private:
  const Arguments& arguments_;
  const Scene& scene_;
  fs::path directory_;
};

// The runs of the ladder; only the first of them if Ctrl-C or SIGTERM has come.
std::vector<Measured> make_all(const Study& study, const std::vector<Rung>& ladder, Progress& progress) {
  run::catch_interrupts();
  progress.start("accuracy", fmt::format("{} runs", ladder.size()));
  std::vector<Measured> runs;
  try {
    for (const Rung& rung : ladder) {
      run::check_interrupt();
      runs.push_back(study.make(rung, runs.size()));
      progress.update(static_cast<double>(runs.size()) / static_cast<double>(ladder.size()),
                      fmt::format("run {} of {}", runs.size(), ladder.size()));
    }
  } catch (const run::Interrupted&) {
    return runs;
  }
  progress.finish("");
  return runs;
}

// Errors of all runs against the exact solution that the scene names, or of all but the finest against that one; says against
// which, or nothing if there is neither. A run that went wrong in time (status 1) has temperatures all the same, and its error
// is worth knowing.
std::string compare_all(const Study& study, std::size_t finest_run, std::vector<Measured>& runs) {
  const auto probes = [&](std::size_t i) { return output::read_probe_history(RunFiles{study.run_directory(i)}.probes()); };
  const bool has_finest = finest_run < runs.size() && runs[finest_run].ran;
  const ProbeHistory best = has_finest ? probes(finest_run) : ProbeHistory{};
  bool exact = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].ran) continue;
    const ProbeHistory history = probes(i);
    exact = exact || !history.exact.empty();
    if (exact) {
      compare(history, exact_of(history), runs[i]);
    } else if (has_finest && i != finest_run) {
      compare(history, reference_from(best), runs[i]);
    }
  }
  if (exact) return "the exact solution of the scene";
  return has_finest ? fmt::format("run {}, the finest", finest_run) : "";
}

// What there is of the table and the picture.
void conclude(const Study& study, const fs::path& directory, std::size_t finest_run, std::vector<Measured>& runs) {
  const fs::path csv = directory / table_name;
  const fs::path picture = directory / picture_name;
  const std::string reference = compare_all(study, finest_run, runs);
  mark_front(runs);
  write_text(csv, to_csv(runs));
  fmt::print("{}", to_text(runs, observed_orders(runs), reference));
  if (draw(runs, csv, picture)) return;
  fs::remove(picture);
  if (!reference.empty()) fmt::print("no run has an error above 0, so there is nothing to draw on logarithmic axes\n");
}

}  // namespace

void declare(CLI::App& command, Arguments& arguments) {
  command.add_option("scene", arguments.scene, "the scene, a YAML file with heat and probes")->required();
  command.add_option("--set", arguments.overrides, "replace a key of the scene")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--out", arguments.directory, "where the results go (default: out/, the scene's name and -accuracy)");
  command.add_option("--mesh", arguments.ladder.mesh_factors, "factors of every mesh_size (default: 2 1 0.5)")
      ->check(CLI::PositiveNumber);
  command.add_option("--tolerance", arguments.tolerances, "time tolerances (default: 10, 1 and 0.1 times the scene's)");
  command.add_option("--integrator", arguments.ladder.integrators, "steps in time (default: the scene's)");
  command.add_option("--contact", arguments.ladder.contact_models, "contact models (default: the scene's)");
  command.add_option("--blocks", arguments.ladder.block_models,
                     "how blocks are resolved: meshed, lumped, auto (default: the scene's)");
  command.add_option("--threads", arguments.threads, "of each run (default: the processors there are)")
      ->check(CLI::Range(1, 1024));
  command.add_flag("--quiet", arguments.quiet, "no progress");
}

int run(const Arguments& arguments) {
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  check_scene(scene);
  LadderOptions options = arguments.ladder;
  for (const std::string& text : arguments.tolerances) options.tolerances.push_back(kelvin_difference(text));
  const std::vector<Rung> ladder = ladder_of(scene, options);
  // What a rung changes may not fit the scene: say so before anything is run.
  for (const Rung& rung : ladder) {
    std::vector<std::string> overrides = arguments.overrides;
    for (const std::string& assignment : overrides_of(scene, rung)) overrides.push_back(assignment);
    read_scene(arguments.scene, overrides);
  }
  const fs::path directory = arguments.directory.empty() ? fs::path("out") / (scene.file.stem().string() + "-accuracy")
                                                         : fs::path(arguments.directory);
  run::make_output_folder(directory);
  const auto lock = run::FileLock::of_command(directory / lock_name, run::FileLock::Kind::exclusive, "accuracy");
  // Of an earlier call: whoever finds them must not take them for what an interrupted one has found.
  for (const char* earlier : {table_name, picture_name}) fs::remove(directory / earlier);

  Progress progress(progress_mode(arguments.quiet));
  const Study study(arguments, scene, directory);
  std::vector<Measured> runs = make_all(study, ladder, progress);
  const std::size_t finest_run = finest(ladder);
  const bool exact = std::any_of(scene.probes.begin(), scene.probes.end(), [](const auto& probe) { return probe.exact; });
  if (finest_run < runs.size() && !runs[finest_run].ran && !exact) {
    throw RunError(fmt::format("the finest run has failed; see {}", (study.run_directory(finest_run) / "log").string()));
  }
  if (!runs.empty()) conclude(study, directory, finest_run, runs);
  if (runs.size() < ladder.size()) {
    fmt::print(stderr, "scree: interrupted after {} of {} runs\n", runs.size(), ladder.size());
    return 130;
  }
  const bool all_ran = std::all_of(runs.begin(), runs.end(), [](const Measured& run) { return run.ran; });
  return all_ran ? 0 : 1;
}

}  // namespace scree::accuracy
