// What the blocks of a body were made from, in words: a scene that takes them from a file may speak of other bodies by the same
// names, and the blocks alone do not tell (a sphere's mesh is no sphere).
#pragma once

#include <string>
#include <vector>

#include "engine/mesh/body_spec.h"

namespace scree::mesh {

// A line "KEY: VALUE" for each of shape, mesh size, kind of elements, rule for blocks, number of copies and, last, their
// places; keys as under bodies.NAME in a scene. Lengths to 12 digits, so that 7 cm are 0.07 m; a mesh file counts by its
// contents.
std::string made_from(const BodySpec& body);

struct MakingDifference {
  std::string key;    // of the second one
  std::string first;  // what it says there, with its key if that is another
  std::string second;
};

enum class Places { compared, left_out };

// Where two such texts differ. Where blocks have fallen, it does not matter any more where they were placed.
std::vector<MakingDifference> differences(const std::string& first, const std::string& second, Places places);

}  // namespace scree::mesh
