// What is wrong with the points of a file, whatever they carry.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/raw_mesh.h"

namespace scree::mesh {

// Throws InputError for a coordinate that is no number, a point that no element uses, and two points at one place: a mesh
// whose parts only seem to be connected would fall apart without a word.
void check_points(const BodySpec& body, const RawMesh& raw);

}  // namespace scree::mesh
