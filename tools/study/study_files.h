// Where a study keeps what.
#pragma once

#include <filesystem>
#include <string>

#include "tools/run/run_files.h"

namespace scree::study {

struct StudyFiles {
  std::filesystem::path directory;

  [[nodiscard]] run::RunFiles run(const std::string& name) const { return {directory / "runs" / name}; }
  [[nodiscard]] std::filesystem::path outcome(const std::string& name) const { return run(name).directory / "outcome.json"; }
  [[nodiscard]] std::filesystem::path log(const std::string& name) const { return run(name).directory / "log"; }
  [[nodiscard]] std::filesystem::path packing(const std::string& name) const { return directory / "packings" / (name + ".h5"); }
  [[nodiscard]] std::filesystem::path packing_lock(const std::string& name) const {
    return directory / "packings" / (name + ".lock");
  }
  [[nodiscard]] std::filesystem::path tables_lock() const { return directory / ".tables.lock"; }  // held while they are written
  [[nodiscard]] std::filesystem::path lock() const { return directory / "lock"; }
  [[nodiscard]] std::filesystem::path table() const { return directory / "table.csv"; }
  [[nodiscard]] std::filesystem::path table_hdf5() const { return directory / "table.h5"; }
  [[nodiscard]] std::filesystem::path ensembles() const { return directory / "ensembles.csv"; }
  [[nodiscard]] std::filesystem::path ensembles_hdf5() const { return directory / "ensembles.h5"; }
};

}  // namespace scree::study
