#include "tools/run/own_inputs.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/output/series.h"

namespace scree::run {

namespace {

namespace fs = std::filesystem;

constexpr std::array series{heat_series, contact_series, settle_series};

std::vector<fs::path> inputs(const Scene& scene) {
  std::vector<fs::path> files = scene.tables;
  if (scene.initial_field) files.push_back(scene.initial_field->from);
  for (const mesh::BodySpec& body : scene.bodies) {
    if (const auto* mesh = std::get_if<mesh::MeshFile>(&body.shape)) files.push_back(mesh->path);
  }
  return files;
}

bool same(const fs::path& one, const fs::path& other) {
  std::error_code ignored;
  return fs::equivalent(one, other, ignored);
}

// Whether a run that starts removes it or writes something else there. Its packing it leaves, if it is to start from that.
bool is_result(const fs::path& file, const RunFiles& files) {
  if (same(file, files.directory) || same(file, files.probes())) return true;
  const fs::path folder = file.parent_path();
  return std::any_of(series.begin(), series.end(), [&](const char* name) {
    return same(file, files.directory / fmt::format("{}.pvd", name)) || same(folder, files.directory / name);
  });
}

// What a run removes or replaces, but for its packing, which may have been put there for it.
std::vector<fs::path> results(const RunFiles& files) {
  std::vector<fs::path> all{files.scene(), files.probes(), files.restart(), files.page()};
  for (const char* name : series) {
    all.push_back(files.picture(name));
    all.push_back(files.directory / fmt::format("{}.pvd", name));
  }
  return all;
}

// A frame of a series, if there is one.
std::optional<fs::path> frame_of(const RunFiles& files, const std::string& name) {
  std::error_code not_there;
  for (const auto& entry : fs::directory_iterator(files.directory / name, not_there)) {
    if (output::is_frame(entry.path(), name)) return entry.path();
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const RunFiles& files, const std::string& rule, const std::string& suggestion) {
  Problem problem;
  problem.key = "--out";
  problem.value = files.directory.string();
  problem.rule = rule;
  problem.suggestion = suggestion;
  throw InputError(std::move(problem));
}

}  // namespace

void refuse_own_inputs(const Scene& scene, const RunFiles& files) {
  for (const fs::path& file : inputs(scene)) {
    if (!is_result(file, files)) continue;
    refuse(files,
           fmt::format("must not be where {} lies, which the run reads: its results would take that place", file.string()),
           "Choose another --out");
  }
  std::error_code ignored;
  if (fs::exists(files.summary(), ignored)) return;
  const auto refuse_file = [&](const fs::path& file) {
    refuse(files, fmt::format("holds a {} that no run has left, and a run removes or replaces it", file.filename().string()),
           "Choose another --out, or another name for that file");
  };
  for (const fs::path& file : results(files)) {
    if (fs::exists(file, ignored)) refuse_file(file);
  }
  for (const char* name : series) {
    if (const auto frame = frame_of(files, name)) refuse_file(*frame);
  }
}

}  // namespace scree::run
