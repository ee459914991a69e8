// The files a run leaves behind (tools/README.md describes them for users).
#pragma once

#include <filesystem>
#include <string>

namespace scree::run {

// Names of its series (engine/output/series.h).
inline constexpr const char* settle_series = "settle";
inline constexpr const char* heat_series = "heat";
inline constexpr const char* contact_series = "contacts";

struct RunFiles {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path scene() const { return directory / "scene.yaml"; }
  [[nodiscard]] std::filesystem::path summary() const { return directory / "summary.json"; }
  [[nodiscard]] std::filesystem::path packing() const { return directory / "packing.h5"; }
  [[nodiscard]] std::filesystem::path probes() const { return directory / "probes.csv"; }
  [[nodiscard]] std::filesystem::path restart() const { return directory / "heat.restart.h5"; }
  // What `scree render` and `scree report` make of them, if they are not told otherwise.
  [[nodiscard]] std::filesystem::path picture(const std::string& series) const { return directory / (series + ".png"); }
  [[nodiscard]] std::filesystem::path page() const { return directory / "report.html"; }
  [[nodiscard]] std::filesystem::path lock() const { return directory / ".lock"; }  // held while a run writes here
};

}  // namespace scree::run
