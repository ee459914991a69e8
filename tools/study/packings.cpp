#include "tools/study/packings.h"

#include "engine/packing/packing.h"

namespace scree::study {

namespace {

namespace fs = std::filesystem;

// The same file under another name, or a copy where the file system has no such links. Files of packings are replaced, never
// changed, so that sharing one is safe.
void share(const fs::path& file, const fs::path& name) {
  std::error_code no_link;
  fs::create_hard_link(file, name, no_link);
  if (no_link && !fs::exists(name)) fs::copy_file(file, name);
}

}  // namespace

void take_packing(const StudyFiles& files, const PlannedRun& run) {
  const fs::path own = files.run(run.directory).packing();
  if (!fs::exists(own)) share(files.packing(run.packing), own);
}

bool publish_packing(const StudyFiles& files, const PlannedRun& run) {
  const fs::path made = files.run(run.directory).packing();
  if (!fs::exists(made) || !packing::stored_key(made)) return false;
  share(made, files.packing(run.packing));
  return true;
}

void publish_packings(const StudyFiles& files, const std::vector<PlannedRun>& runs) {
  for (const PlannedRun& run : runs) {
    if (!run.packing.empty() && !fs::exists(files.packing(run.packing))) publish_packing(files, run);
  }
}

}  // namespace scree::study
