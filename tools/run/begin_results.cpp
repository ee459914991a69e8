#include "tools/run/begin_results.h"

#include <string>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/output/series.h"
#include "tools/run/summary.h"

namespace scree::run {

namespace {

void remove_results(const RunContext& context) {
  const RunFiles& files = context.files;
  for (const char* series : {heat_series, contact_series}) output::remove_series(files.directory, series);
  if (!context.scene.settle) {
    output::remove_series(files.directory, settle_series);
    std::error_code not_there;
    const bool is_read =
        context.scene.packing && std::filesystem::equivalent(*context.scene.packing, files.packing(), not_there);
    if (!is_read) std::filesystem::remove(files.packing());
  }
  for (const auto& file : {files.probes(), files.restart()}) std::filesystem::remove(file);
}

// What was made of the results so far, which a run that goes on changes, too. Those of a fall are removed with it.
void remove_pictures(const RunContext& context) {
  const RunFiles& files = context.files;
  for (const char* series : {heat_series, contact_series}) std::filesystem::remove(files.picture(series));
  if (!context.scene.settle) std::filesystem::remove(files.picture(settle_series));
  std::filesystem::remove(files.page());
}

void remove_earlier(const RunContext& context) {
  try {
    remove_pictures(context);
    if (!context.resume) remove_results(context);
  } catch (const std::filesystem::filesystem_error& error) {
    throw RunError(
        fmt::format("{}: cannot be removed ({}). Choose another --out", error.path1().string(), error.code().message()));
  }
}

// The names of this run before anything of an earlier one is gone, whenever it is killed: first that it goes on, as a scene
// without a summary is none that a run has left (own_inputs.h).
void name_at_once(const RunFiles& files, const std::string& summary, const std::string& scene) {
  write_unflushed(files.summary(), summary);
  write_unflushed(files.scene(), scene);
}

}  // namespace

void begin_results(RunContext& context) {
  if (context.begun) return;
  context.begun = true;
  const std::string summary = text_of(opening_summary(context));
  const std::string& scene = context.scene.effective;
  if (!context.resume) name_at_once(context.files, summary, scene);
  remove_earlier(context);
  // Once more, on the disk together with what is written next.
  write_text(context.files.summary(), summary);
  write_text(context.files.scene(), scene);
}

}  // namespace scree::run
