#include "tools/run/claim.h"

#include <fmt/format.h>

#include "engine/base/check.h"
#include "tools/run/output_place.h"

namespace scree::run {

namespace {

namespace fs = std::filesystem;

// Those of a directory and the ones above it that are not there, deepest first.
std::vector<fs::path> missing(const fs::path& directory) {
  std::vector<fs::path> paths;
  std::error_code ignored;
  for (fs::path path = fs::absolute(directory).lexically_normal(); !fs::exists(path, ignored) && path.has_relative_path();
       path = path.parent_path()) {
    paths.push_back(path);
  }
  return paths;
}

}  // namespace

Claim::Claim(const RunFiles& files) : made_(missing(files.directory)) {
  make_output_folder(files.directory);
  if (std::error_code ignored; !fs::exists(files.lock(), ignored)) made_.insert(made_.begin(), files.lock());
  lock_ = FileLock::take(files.lock(), FileLock::Kind::exclusive, FileLock::Heirs::none);
  if (!lock_) throw RunError(fmt::format("{}: another run writes there. Choose another --out", files.directory.string()));
}

// A directory in which somebody else has put something stays.
void Claim::undo() {
  std::error_code ignored;
  for (const fs::path& path : made_) fs::remove(path, ignored);
  lock_.reset();
}

}  // namespace scree::run
