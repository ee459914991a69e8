// `scree accuracy`: error against cost of a scene, over meshes, tolerances, integrators and contact models.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/accuracy/ladder.h"

namespace scree::accuracy {

struct Arguments {
  std::string scene;
  std::vector<std::string> overrides;
  std::string directory;                // empty: out/ and the scene's name and -accuracy
  std::vector<std::string> tolerances;  // quantities
  LadderOptions ladder;                 // its tolerances come from those above
  int threads = 0;                      // of each run; 0: the processors there are
  bool quiet = false;
};

void declare(CLI::App& command, Arguments& arguments);

int run(const Arguments& arguments);

}  // namespace scree::accuracy
