#include "tools/run/begin_results.h"

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/output/series.h"
#include "tools/run/summary.h"

namespace scree::run {

namespace {

void remove(const RunFiles& files, const char* series) {
  output::remove_series(files.directory, series);
  std::filesystem::remove(files.picture(series));
}

void remove_earlier(const RunContext& context) {
  const RunFiles& files = context.files;
  try {
    for (const char* series : {heat_series, contact_series}) remove(files, series);
    if (!context.scene.settle) {
      remove(files, settle_series);
      std::error_code not_there;
      const bool is_read =
          context.scene.packing && std::filesystem::equivalent(*context.scene.packing, files.packing(), not_there);
      if (!is_read) std::filesystem::remove(files.packing());
    }
    for (const auto& file : {files.probes(), files.restart(), files.page()}) std::filesystem::remove(file);
  } catch (const std::filesystem::filesystem_error& error) {
    throw RunError(
        fmt::format("{}: cannot be removed ({}). Choose another --out", error.path1().string(), error.code().message()));
  }
}

}  // namespace

void begin_results(RunContext& context) {
  if (context.begun) return;
  context.begun = true;
  if (!context.resume) remove_earlier(context);
  // In this order: a scene without a summary is none that a run has left (own_inputs.h).
  write_summary(context.files, opening_summary(context));
  write_text(context.files.scene(), context.scene.effective);
}

}  // namespace scree::run
