// What the mesher says when a body cannot be meshed.
#pragma once

#include <string>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/mesh/body_spec.h"

namespace scree::mesh {

// A problem of `body`; `key` is the rest of the path after bodies.NAME, such as "mesh.file".
inline InputError body_error(const BodySpec& body, const std::string& key, const std::string& value, const std::string& rule,
                             const std::string& suggestion) {
  return InputError(Problem{body.where, "bodies." + body.name + (key.empty() ? "" : "." + key), value, rule, suggestion});
}

// A wrong mesh file.
inline InputError file_error(const BodySpec& body, const std::string& rule, const std::string& suggestion) {
  return body_error(body, "mesh.file", std::get<MeshFile>(body.shape).path.string(), rule, suggestion);
}

// About how many triangles (tetrahedra) of this size cover an area [m2] (fill a volume [m3]): a regular triangle has sqrt(3)/4
// of its edge squared, a tetrahedron in a packing about 0.12 of it cubed.
inline double triangles_in(double area, double size) {
  return area / (0.43 * size * size);
}
inline double tetrahedra_in(double volume, double size) {
  return volume / (0.12 * size * size * size);
}

// Refuses a mesh_size that would fill the memory; `elements` is what it is expected to make.
inline void expect_reasonable(const BodySpec& body, double elements) {
  constexpr double most = 2e7;
  if (elements <= most) return;
  throw body_error(body, "mesh_size", fmt::format("{} m", body.mesh_size),
                   fmt::format("it would make about {:.2g} elements, and {:.0g} are the most", elements, most),
                   std::holds_alternative<MeshFile>(body.shape)
                       ? "Choose a larger mesh_size, or say in mesh.scale what the file's unit is"
                       : "Choose a larger mesh_size");
}

}  // namespace scree::mesh
