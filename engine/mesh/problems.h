// What the mesher says when a body cannot be meshed.
#pragma once

#include <string>

#include "engine/base/check.h"
#include "engine/mesh/body_spec.h"

namespace scree::mesh {

// A problem of `body`; `key` is the rest of the path after bodies.NAME, such as "mesh.file".
inline InputError body_error(const BodySpec& body, const std::string& key, const std::string& value, const std::string& rule,
                             const std::string& suggestion) {
  return InputError(Problem{body.where, "bodies." + body.name + (key.empty() ? "" : "." + key), value, rule, suggestion});
}

inline InputError file_error(const BodySpec& body, const std::string& rule, const std::string& suggestion) {
  return body_error(body, "mesh.file", std::get<MeshFile>(body.shape).path.string(), rule, suggestion);
}

}  // namespace scree::mesh
