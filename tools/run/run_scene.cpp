#include "tools/run/run_scene.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "tools/run/certificate.h"
#include "tools/run/earlier_results.h"
#include "tools/run/file_lock.h"
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

void write_summary(const RunFiles& files, const Json& summary) {
  write_text(files.summary(), summary.dump(2) + "\n");
}

// Two runs into one directory would each take the other's files away.
FileLock claim_directory(const RunFiles& files) {
  std::error_code error;
  std::filesystem::create_directories(files.directory, error);
  if (error)
    throw RunError(fmt::format("{}: cannot be created ({}). Choose another --out", files.directory.string(), error.message()));
  auto lock = FileLock::take(files.lock(), FileLock::Kind::exclusive, FileLock::Heirs::none);
  if (!lock) throw RunError(fmt::format("{}: another run writes there. Choose another --out", files.directory.string()));
  return std::move(*lock);
}

// Until the run ends its summary says that it has not.
Json open_summary(const RunContext& context) {
  write_text(context.files.scene(), context.scene.effective);
  Json summary = opening_summary(context.scene, "running");
  summary["error_estimate"] = context.estimate_space_error;
  write_summary(context.files, summary);
  return summary;
}

// A run that goes on estimates what it did before.
bool was_estimated(const RunFiles& files) {
  std::ifstream stream(files.summary());
  const Json summary = Json::parse(stream, nullptr, false);
  return summary.is_object() && summary.value("error_estimate", false);
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
    if (lost > 0)
      context.progress.note(fmt::format("lost: {} blocks left the scene; settle.lost of the summary names them", lost));
    auto reasons = unsound(scene, outcome.packing);
    if (!reasons.empty()) return {"not_settled", 1, std::move(reasons)};
  }
  if (!scene.heat) {
    remove_earlier(context);
    return {"complete", 0, {}};
  }
  const HeatOutcome<dim> heat = heat_stage(context, std::move(outcome.packing));
  add_heat(summary, scene, heat);
  auto reasons = unsound(scene, heat.state);
  if (!reasons.empty()) return {"not_converged", 1, std::move(reasons)};
  return {"complete", 0, {}};
}

Ending run_to_an_end(RunContext& context, Json& summary) {
  try {
    return context.scene.dimension == 2 ? run_stages<2>(context, summary) : run_stages<3>(context, summary);
  } catch (const Interrupted&) {
    return {
        "interrupted",
        130,
        {fmt::format("interrupted; `scree resume {}` goes on from the last finished time", context.files.directory.string())}};
  } catch (const InputError& error) {
    return {"bad_input", 2, {located(context.scene, error).what()}};
  } catch (const std::exception& error) {
    return {"failed", 1, {error.what()}};
  }
}

}  // namespace

int run_scene(const Scene& scene, const RunFiles& files, Start start, Progress& progress, SpaceErrors space_errors) {
  catch_interrupts();
  const FileLock lock = claim_directory(files);
  say_models(scene, progress);
  const bool resume = start == Start::resume;
  RunContext context{scene, files, progress, resume,
                     space_errors == SpaceErrors::estimated || (resume && was_estimated(files))};
  Json summary = open_summary(context);
  const Ending ending = run_to_an_end(context, summary);
  summary["status"] = ending.status;
  if (!ending.reasons.empty()) summary["reasons"] = ending.reasons;
  add_stages(summary, context.costs);
  write_summary(files, summary);
  say_costs(context.costs, progress);
  progress.end({ending.status, ending.code, files.directory.string(), ending.reasons});
  for (const std::string& reason : ending.reasons) fmt::print(stderr, "scree: {}\n", reason);
  return ending.code;
}

}  // namespace scree::run
