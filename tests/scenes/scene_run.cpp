#include "tests/scenes/scene_run.h"

#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

#include "engine/base/check.h"
#include "engine/base/progress.h"
#include "tests/temp_folder.h"
#include "tools/run/run_scene.h"
#include "tools/scene/read_scene.h"

namespace scree::test {

namespace {

std::filesystem::path file_of(const std::string& scene) {
  return std::filesystem::path(SCREE_SOURCE_DIR) / "scenes" / (scene + ".yaml");
}

}  // namespace

std::filesystem::path fresh_directory(const std::string& name) {
  const auto directory = temp_folder() / name;
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  return directory;
}

packing::Packing<3> SceneRun::packing() const {
  return packing::read<3>(directory / "packing.h5");
}

std::map<std::string, std::vector<double>> SceneRun::probes() const {
  std::ifstream file(directory / "probes.csv");
  std::string line;
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream row(line);
    std::string cell;
    for (std::size_t i = 0; std::getline(row, cell, ','); ++i) {
      if (columns.size() <= i && names.size() <= i) {
        names.push_back(cell);
      } else {
        columns[names[i]].push_back(std::stod(cell));
      }
    }
  }
  return columns;
}

SceneRun run(const std::string& scene, const std::filesystem::path& directory, const std::vector<std::string>& overrides) {
  return run_file(file_of(scene), directory, overrides);
}

std::string refusal(const std::string& scene, const std::filesystem::path& directory,
                    const std::vector<std::string>& overrides) {
  return refusal_of_file(file_of(scene), directory, overrides);
}

std::string refusal_of_file(const std::filesystem::path& scene, const std::filesystem::path& directory,
                            const std::vector<std::string>& overrides) {
  try {
    run_file(scene, directory, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

SceneRun run_file(const std::filesystem::path& scene, const std::filesystem::path& directory,
                  const std::vector<std::string>& overrides) {
  Progress progress(ProgressMode::quiet);
  SceneRun result{0, directory, {}};
  result.exit_status = run::run_scene(read_scene(scene, overrides), {directory}, run::Start::fresh, progress);
  result.summary = nlohmann::json::parse(contents(directory / "summary.json"));
  return result;
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> listed_frames(const std::filesystem::path& pvd) {
  const std::string text = contents(pvd);
  const std::regex entry("file=\"([^\"]+)\"");
  std::vector<std::string> files;
  for (std::sregex_iterator it(text.begin(), text.end(), entry), end; it != end; ++it) files.push_back((*it)[1]);
  return files;
}

}  // namespace scree::test
