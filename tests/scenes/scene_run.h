// Runs a scene of scenes/ as the command would and reads what it left behind.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/packing/packing.h"

namespace scree::test {

// A folder of its own for a test, empty at its start.
std::filesystem::path fresh_directory(const std::string& name);

struct SceneRun {
  int exit_status = 0;
  std::filesystem::path directory;
  nlohmann::json summary;

  [[nodiscard]] packing::Packing<3> packing() const;
  // Columns of probes.csv by name; "time" in seconds, the others in kelvin.
  [[nodiscard]] std::map<std::string, std::vector<double>> probes() const;
};

// `scene` is a name in scenes/, without the extension.
SceneRun run(const std::string& scene, const std::filesystem::path& directory, const std::vector<std::string>& overrides = {});

SceneRun run_file(const std::filesystem::path& scene, const std::filesystem::path& directory,
                  const std::vector<std::string>& overrides = {});

// What a scene is refused with before any work; "accepted" if it is not.
std::string refusal(const std::string& scene, const std::filesystem::path& directory,
                    const std::vector<std::string>& overrides = {});
std::string refusal_of_file(const std::filesystem::path& scene, const std::filesystem::path& directory,
                            const std::vector<std::string>& overrides = {});

// The bytes of a file.
std::string contents(const std::filesystem::path& file);

// Names of the data files a .pvd lists.
std::vector<std::string> listed_frames(const std::filesystem::path& pvd);

}  // namespace scree::test
