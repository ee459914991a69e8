#include "tools/run/run_scene.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "engine/base/version.h"
#include "tools/run/begin_results.h"
#include "tools/run/certificate.h"
#include "tools/run/claim.h"
#include "tools/run/own_inputs.h"
#include "tools/run/summary.h"
#include "tools/scene/doctor.h"
#include "tools/scene/read_scene.h"

namespace scree::run {

namespace {

struct Ending {
  std::string status;
  int code = 0;
  std::vector<std::string> reasons;  // why the code is not 0
};

// What a run has left, or an empty object.
Json earlier_summary(const RunFiles& files) {
  std::ifstream stream(files.summary());
  Json summary = Json::parse(stream, nullptr, false);
  return summary.is_object() ? summary : Json::object();
}

// A run that goes on estimates what it did before.
bool was_estimated(const RunFiles& files) {
  const Json summary = earlier_summary(files);
  const auto estimated = summary.find("error_estimate");
  return estimated != summary.end() && *estimated == true;
}

// States and packings are taken by the version that has left them alone: another would settle the blocks once more, in place of
// those that it could not go on with.
void refuse_other_version(const RunFiles& files) {
  const Json summary = earlier_summary(files);
  const auto found = summary.find("version");
  if (found == summary.end() || *found == std::string(version())) return;
  Problem problem;
  problem.key = "directory";
  problem.value = files.directory.string();
  problem.rule = fmt::format("must be that of a run by this version, {}; it is by {}", version(), found->dump());
  problem.suggestion = "Resume it by that version, or run its scene again";
  throw InputError(problem);
}

void say_models(const Scene& scene, Progress& progress) {
  for (const Model& model : models_of(scene)) {
    progress.note(fmt::format("{}: {} ({})", model.modelled ? "model" : "left out", model.name, model.reason));
  }
}

void say_costs(const std::vector<StageCost>& costs, Progress& progress) {
  for (const StageCost& cost : costs) {
    progress.note(fmt::format("cost: {:<10} {:9.2f} s {:9.1f} MB", cost.name, cost.wall_seconds,
                              static_cast<double>(cost.peak_memory_bytes) / 1e6));
  }
}

// Runs the stages the scene names and adds what they found to the summary.
template <int dim>
Ending run_stages(RunContext& context, Json& summary) {
  const Scene& scene = context.scene;
  PackingOutcome<dim> outcome = packing_stage<dim>(context);
  add_packing(summary, outcome);
  if constexpr (dim == 3) {
    if (scene.settle) {
      summary["settle"]["certificate"] =
          context.stage("certificate", "what the pile is", [&] { return certificate(scene, outcome.packing); });
    }
  }
  if (outcome.packing.settled) {
    const std::size_t lost = outcome.packing.settled->lost_blocks.size();
    if (lost > 0) context.remark(fmt::format("lost: {} blocks left the scene; settle.lost of the summary names them", lost));
    auto reasons = unsound(scene, outcome.packing);
    if (!reasons.empty()) return {"not_settled", 1, std::move(reasons)};
  }
  if (!scene.heat) {
    begin_results(context);
    keep_placed(context, outcome.packing);
    return {"complete", 0, {}};
  }
  const HeatOutcome<dim> heat = heat_stage(context, std::move(outcome.packing));
  add_heat(summary, scene, heat);
  auto reasons = unsound(scene, heat);
  if (!reasons.empty()) return {"not_converged", 1, std::move(reasons)};
  if (const auto hidden = hidden_by_rounding(scene, heat)) context.remark(*hidden);
  return {"complete", 0, {}};
}

// A run that ended before it had anything to write.
bool leaves_earlier_results(const RunContext& context) {
  return !context.begun && !context.resume && std::filesystem::exists(context.files.summary());
}

// Throws InputError if the scene is refused before any work.
Ending run_to_an_end(RunContext& context, Claim& claim, Json& summary) {
  try {
    return context.scene.dimension == 2 ? run_stages<2>(context, summary) : run_stages<3>(context, summary);
  } catch (const Interrupted&) {
    std::string reason = "interrupted";
    if (!leaves_earlier_results(context)) {
      reason += fmt::format("; `scree resume {}` goes on from the last finished time", context.files.directory.string());
    }
    return {"interrupted", 130, {std::move(reason)}};
  } catch (const InputError& error) {
    const InputError refusal = located(context.scene, error);
    if (!context.begun) {
      claim.undo();
      context.progress.end({"bad_input", 2, "", {refusal.what()}});
      throw refusal;
    }
    return {"bad_input", 2, {refusal.what()}};
  } catch (const std::exception& error) {
    return {"failed", 1, {error.what()}};
  }
}

void add_ending(Json& summary, const Ending& ending) {
  summary["status"] = ending.status;
  if (!ending.reasons.empty()) summary["reasons"] = ending.reasons;
}

// The summary behind the others, as it says what they are.
void write_last_files(RunContext& context, Json& summary, Ending& ending) {
  add_ending(summary, ending);
  try {
    {
      const FilesTogether::Scope scope(context.last_files);
      write_summary(context.files, summary);
    }
    context.last_files.publish();
  } catch (const RunError& error) {
    ending = {"failed", 1, {error.what()}};
    add_ending(summary, ending);
    write_summary(context.files, summary);
  }
}

// The directory, for this run alone. What keeps the run out of it ends it, for whoever reads its events, too.
Claim claim_directory(const Scene& scene, const RunFiles& files, Start start, Progress& progress) {
  try {
    if (start == Start::fresh) {
      refuse_own_inputs(scene, files);
    } else {
      refuse_other_version(files);
    }
    return Claim(files);
  } catch (const InputError& error) {
    progress.end({"bad_input", 2, "", {error.what()}});
    throw;
  } catch (const RunError& error) {
    progress.end({"failed", 1, "", {error.what()}});
    throw;
  }
}

// Whoever reads the events is told the end even if the summary cannot be written.
void end_results(RunContext& context, Json& summary, Ending& ending) {
  try {
    begin_results(context);
    if (!context.remarks.empty()) summary["remarks"] = context.remarks;
    add_stages(summary, context.costs);
    write_last_files(context, summary, ending);
  } catch (const RunError& error) {
    context.progress.end({"failed", 1, context.files.directory.string(), {error.what()}});
    throw;
  }
  say_costs(context.costs, context.progress);
}

}  // namespace

int run_scene(const Scene& scene, const RunFiles& files, Start start, Progress& progress, SpaceErrors space_errors) {
  catch_interrupts();
  Claim claim = claim_directory(scene, files, start, progress);
  say_models(scene, progress);
  const bool resume = start == Start::resume;
  RunContext context{.scene = scene,
                     .files = files,
                     .progress = progress,
                     .resume = resume,
                     .estimate_space_error = space_errors == SpaceErrors::estimated || (resume && was_estimated(files))};
  for (const std::string& sentence : scene.bare_values) context.remark("suspicious: " + sentence);
  Json summary = opening_summary(context);
  Ending ending = run_to_an_end(context, claim, summary);
  if (leaves_earlier_results(context)) {
    claim.undo();
    ending.reasons.push_back(fmt::format("nothing was begun: {} is what an earlier run left", files.directory.string()));
  } else {
    end_results(context, summary, ending);
  }
  progress.end({ending.status, ending.code, files.directory.string(), ending.reasons});
  for (const std::string& reason : ending.reasons) fmt::print(stderr, "scree: {}\n", reason);
  return ending.code;
}

}  // namespace scree::run
