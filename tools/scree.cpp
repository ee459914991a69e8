// The command: run, resume, check, render, report, accuracy, study, plot, keys, schema, completion, manual. Exit status: 0
// complete and sound; 1 the run was not; 2 bad input.

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "engine/base/check.h"
#include "engine/base/heap_pages.h"
#include "engine/base/key_reference.h"
#include "engine/base/nearest.h"
#include "engine/base/progress.h"
#include "engine/base/threads.h"
#include "engine/base/version.h"
#include "engine/mesh/make_blocks.h"
#include "engine/output/read_vtu.h"
#include "engine/packing/remaining.h"
#include "tools/accuracy/accuracy_command.h"
#include "tools/command_line/completion.h"
#include "tools/command_line/expect_values.h"
#include "tools/command_line/manual.h"
#include "tools/render_command.h"
#include "tools/report/report_command.h"
#include "tools/run/keys.h"
#include "tools/run/packing_stage.h"
#include "tools/run/preflight.h"
#include "tools/run/run_scene.h"
#include "tools/scene/doctor.h"
#include "tools/scene/keys.h"
#include "tools/scene/read_scene.h"
#include "tools/study/plot.h"
#include "tools/study/study_command.h"

namespace {

using scree::run::RunFiles;

struct Arguments {
  std::string scene;
  std::string directory;
  std::vector<std::string> overrides;
  std::string planned;
  std::string prefix;
  std::string shell;
  bool quiet = false;
  bool json = false;
  bool error_estimate = false;
  int threads = scree::available_processors();
  scree::RenderArguments render;
  scree::report::ReportArguments report;
  scree::accuracy::Arguments accuracy;
  scree::study::Arguments study;
  scree::study::PlotArguments plot;
};

void add_scene(CLI::App& command, Arguments& arguments) {
  command.add_option("scene", arguments.scene, "the scene, a YAML file")->required();
  command.add_option("--set", arguments.overrides, "replace a key of the scene: --set heat.until=\"2 h\"")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

std::string default_directory(const std::string& scene) {
  return (std::filesystem::path("out") / std::filesystem::path(scene).stem()).string();
}

scree::run::SpaceErrors space_errors(const Arguments& arguments) {
  return arguments.error_estimate ? scree::run::SpaceErrors::estimated : scree::run::SpaceErrors::left_out;
}

scree::ProgressMode progress_mode(const Arguments& arguments) {
  return arguments.json ? scree::ProgressMode::json : scree::progress_mode(arguments.quiet);
}

// A program that follows the run is told of a bad scene in its own way, too.
template <class Read>
scree::Scene read_scene(const Arguments& arguments, scree::Progress& progress, const Read& read) {
  try {
    return read();
  } catch (const scree::InputError& error) {
    if (arguments.json) progress.end({"bad_input", 2, "", {error.what()}});
    throw;
  }
}

int run(const Arguments& arguments) {
  scree::Progress progress(progress_mode(arguments));
  const scree::Scene scene = read_scene(arguments, progress, [&] {
    scree::Scene read = scree::read_scene(arguments.scene, arguments.overrides);
    if (!arguments.planned.empty()) scree::run::expect_planned(read, arguments.planned, arguments.error_estimate);
    return read;
  });
  const std::string directory = arguments.directory.empty() ? default_directory(arguments.scene) : arguments.directory;
  return scree::run::run_scene(scene, {directory}, scree::run::Start::fresh, progress, space_errors(arguments));
}

void expect_run(const RunFiles& files) {
  if (std::error_code ignored; std::filesystem::exists(files.scene(), ignored)) return;
  scree::Problem problem;
  problem.key = "directory";
  problem.value = files.directory.string();
  problem.rule = "must be that of a run, which holds its scene.yaml";
  problem.suggestion = "A run that ended before it had one left nothing to go on from: run its scene again";
  throw scree::InputError(problem);
}

int resume(const Arguments& arguments) {
  const RunFiles files{arguments.directory};
  scree::Progress progress(progress_mode(arguments));
  const scree::Scene scene = read_scene(arguments, progress, [&] {
    expect_run(files);
    return scree::read_scene(files.scene(), arguments.overrides);
  });
  return scree::run::run_scene(scene, files, scree::run::Start::resume, progress, space_errors(arguments));
}

template <int dim>
std::string check_report(const scree::Scene& scene) {
  const auto packing =
      scene.packing ? scree::run::stored_packing<dim>(scene)
                    : scree::packing::unmoved<dim>(scree::mesh::make_blocks<dim>(scene.bodies, scree::output::mesh_readers()));
  const auto blocks = scree::packing::remaining(packing).mesh;
  if constexpr (dim == 3) {
    if (scene.settle) scree::run::check_fall(scene, blocks);
  }
  scene.settle ? scree::run::check_heat(scene, blocks) : scree::run::check_placed(scene, packing);
  return scree::to_text(scree::check_scene(scene, blocks));
}

int check(const Arguments& arguments) {
  const scree::Scene scene = scree::read_scene(arguments.scene, arguments.overrides);
  try {
    fmt::print("{}", scene.dimension == 2 ? check_report<2>(scene) : check_report<3>(scene));
  } catch (const scree::InputError& error) {
    throw scree::located(scene, error);
  }
  return 0;
}

std::string keys_that_begin_with(const std::string& prefix) {
  std::string text = scree::key_reference(scree::scene_keys(), prefix);
  if (!text.empty()) return text;
  std::vector<std::string> known;
  for (const scree::Key& key : scree::scene_keys().keys()) {
    if (!key.implied) known.push_back(key.path);
  }
  scree::Problem problem;
  problem.key = "prefix";
  problem.value = prefix;
  problem.rule = "must begin a key of a scene";
  if (const auto close = scree::nearest(prefix, known)) problem.suggestion = fmt::format("Did you mean {}?", *close);
  throw scree::InputError(problem);
}

// What the program knows of itself: its keys and its options.
void print_reference(const CLI::App& app, const Arguments& arguments) {
  const auto commands = scree::command_line::command_table(app);
  std::string text;
  if (app.got_subcommand("keys")) text = keys_that_begin_with(arguments.prefix);
  if (app.got_subcommand("schema")) text = scree::key_schema(scree::scene_keys(), "Scree scene");
  if (app.got_subcommand("manual")) text = scree::command_line::manual(commands, std::string(scree::version()));
  if (app.got_subcommand("completion")) {
    text = arguments.shell == "zsh" ? scree::command_line::zsh_completion(commands)
                                    : scree::command_line::bash_completion(commands);
  }
  fmt::print("{}", text);
}

int dispatch(CLI::App& app, const Arguments& arguments) {
  scree::use_threads(arguments.threads);
  if (app.got_subcommand("run")) return run(arguments);
  if (app.got_subcommand("resume")) return resume(arguments);
  if (app.got_subcommand("check")) return check(arguments);
  if (app.got_subcommand("render")) return scree::render_command(arguments.render);
  if (app.got_subcommand("report")) return scree::report::report_command(arguments.report);
  if (app.got_subcommand("accuracy")) return scree::accuracy::run(arguments.accuracy);
  if (app.got_subcommand("study")) return scree::study::run(arguments.study);
  if (app.got_subcommand("plot")) return scree::study::plot_command(arguments.plot);
  print_reference(app, arguments);
  return 0;
}

// What was printed must have arrived: a full disk often shows only here.
void flush_output() {
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    throw scree::RunError("standard output could not be written");
  }
}

void declare_running(CLI::App& app, Arguments& arguments) {
  CLI::App* run = app.add_subcommand("run", "run a scene");
  add_scene(*run, arguments);
  run->add_option("--out", arguments.directory, "where the results go (default: out/ and the scene's name)");
  run->add_option("--planned", arguments.planned, "for studies: refuse a scene of another key, as it has changed since")
      ->group("");
  CLI::App* resume = app.add_subcommand("resume", "go on with an interrupted run from its last finished time");
  resume->add_option("directory", arguments.directory, "the interrupted run's --out")->required();
  for (CLI::App* command : {run, resume}) {
    CLI::Option* quiet = command->add_flag("--quiet", arguments.quiet, "say nothing but what is wrong");
    command->add_flag("--json", arguments.json, "progress for a program: one JSON object a line on standard output")
        ->excludes(quiet);
    command->add_flag("--error-estimate", arguments.error_estimate, "estimate the space error of every element, too");
    command
        ->add_option("--threads", arguments.threads,
                     "at most how many threads (default: the processors there are); no result depends on it")
        ->check(CLI::Range(1, 1024));
  }
  CLI::App* check = app.add_subcommand("check", "find everything wrong or suspicious in a scene without running it");
  add_scene(*check, arguments);
}

void declare_reference(CLI::App& app, Arguments& arguments) {
  CLI::App* keys = app.add_subcommand("keys", "print every key of a scene, its unit, default and rule");
  keys->add_option("prefix", arguments.prefix, "only keys that begin with this, such as heat");
  app.add_subcommand("schema", "print the JSON schema of a scene, for editors");
  app.add_subcommand("completion", "print the completion of this command for a shell")
      ->add_option("shell", arguments.shell, "bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  app.add_subcommand("manual", "print the manual page of this command, for man");
}

void declare(CLI::App& app, Arguments& arguments) {
  app.set_version_flag("--version", scree::version_text());
  app.require_subcommand(1);
  declare_running(app, arguments);
  scree::declare_render(*app.add_subcommand("render", "draw a picture of a run, without a screen"), arguments.render);
  scree::report::declare_report(*app.add_subcommand("report", "one page about a run or a study, for a browser"),
                                arguments.report);
  scree::accuracy::declare(*app.add_subcommand("accuracy", "error against cost: a scene over meshes, tolerances and models"),
                           arguments.accuracy);
  scree::study::declare(*app.add_subcommand("study", "make many runs of a scene and one table of them"), arguments.study);
  scree::study::declare_plot(*app.add_subcommand("plot", "draw one column of a study's table against another"), arguments.plot);
  declare_reference(app, arguments);
}

// A word in the place of a command that is none: the library says only that one is required.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, char** argv) {
  const bool word = argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty();
  if (!word) return std::nullopt;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return fmt::format("scree: {} is no command. {}\n", argv[1], scree::suggest(argv[1], names));
}

// The exit status, if nothing is left to be done: --help or --version, or something is wrong with the command.
std::optional<int> end_of_parsing(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (const auto unknown = unknown_command(app, argc, argv)) {
      fmt::print(stderr, "{}", *unknown);
      return 2;
    }
    return app.exit(error) == 0 ? 0 : 2;
  }
}

int command(int argc, char** argv) {
  CLI::App app("Scree: bodies fall apart into blocks, pile up and are heated.", "scree");
  Arguments arguments;
  declare(app, arguments);
  scree::command_line::expect_values(app);
  try {
    const std::optional<int> end = end_of_parsing(app, argc, argv);
    const int status = end ? *end : dispatch(app, arguments);
    flush_output();
    return status;
  } catch (const scree::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "scree: {}\n", error.what());
    return 1;
  }
}

}  // namespace

// Before other static objects, of which HDF5's take a hundred pages of 4 kB.
[[gnu::constructor(101)]] static void begin_heap() {
  scree::keep_heap_in_huge_pages();
}

int main(int argc, char** argv) {
  // A file that a limit of the system keeps from growing is an error of writing it, as on a full disk, and not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return command(argc, argv);
  } catch (...) {
    return 1;  // not even standard error takes the message
  }
}
