// One run, from a scene to its files.
#pragma once

#include "engine/base/progress.h"
#include "tools/run/run_files.h"
#include "tools/scene/scene.h"

namespace scree::run {

enum class Start { fresh, resume };
enum class SpaceErrors { left_out, estimated };

// The exit status of the command: 0 complete and sound; 1 did not settle, converge, balance, or could not go on; 2 bad input;
// 130 interrupted. Throws InputError, and leaves the directory as it was, where the scene is refused before any work.
int run_scene(const Scene& scene, const RunFiles& files, Start start, Progress& progress,
              SpaceErrors space_errors = SpaceErrors::left_out);

}  // namespace scree::run
