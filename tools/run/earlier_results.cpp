#include "tools/run/earlier_results.h"

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/output/series.h"

namespace scree::run {

void remove_earlier(const RunContext& context) {
  if (context.resume) return;
  const RunFiles& files = context.files;
  try {
    for (const char* series : {"heat", "contacts"}) output::remove_series(files.directory, series);
    if (!context.scene.settle) output::remove_series(files.directory, "settle");
    for (const auto& file : {files.probes(), files.restart()}) std::filesystem::remove(file);
  } catch (const std::filesystem::filesystem_error& error) {
    throw RunError(
        fmt::format("{}: cannot be removed ({}). Choose another --out", error.path1().string(), error.code().message()));
  }
}

}  // namespace scree::run
