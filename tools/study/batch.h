// The same study as tasks for what clusters run already.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace scree::study {

struct Batch {
  std::filesystem::path study;
  std::filesystem::path directory;
  int tasks = 0;
  std::optional<int> threads;  // of each task; nothing: one
};

// A job array for `sbatch`, a task per run. Throws InputError for a name that sbatch cannot take.
std::string slurm_script(const Batch& batch);

// A shell script that makes the runs by GNU parallel and gathers them. Throws InputError for a name that it would change.
std::string parallel_script(const Batch& batch);

}  // namespace scree::study
