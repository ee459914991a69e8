// A key of a scene, found by its path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/key_table.h"

namespace scree::study {

// `heat.boundaries[0].temperature` or `heat.boundaries.0.temperature`, which are the same; or one number of a vector,
// `bodies.cube.box.size[2]`.
struct ScenePath {
  const KeyNode* node = nullptr;   // it, with its row, and those below it; that of the vector for one of its numbers
  std::vector<std::string> parts;  // heat, boundaries, 0, temperature

  // The same key, or one below this.
  [[nodiscard]] bool holds(const ScenePath& other) const;
};

// Nothing for a path that no scene has, and for one with a number or a name missing or written in another way than here.
std::optional<ScenePath> scene_path(const std::string& path);

// The path that was probably meant, with the names and numbers of this one; or where all of them are listed.
std::string suggest_path(const std::string& path);

}  // namespace scree::study
