// `scree check`: what a scene would model, how large it is, and what in it is probably not meant.
#pragma once

#include <string>
#include <vector>

#include "engine/mesh/block_mesh.h"
#include "tools/scene/scene.h"

namespace scree {

struct Model {
  std::string name;
  bool modelled = false;
  std::string reason;
};

struct BodyCount {
  std::string name;
  std::size_t blocks = 0;
  std::size_t elements = 0;
  std::size_t nodes = 0;
};

struct CheckReport {
  std::vector<Model> models;
  std::vector<BodyCount> bodies;        // in the order of the scene
  std::vector<std::string> suspicious;  // sentences
};

// What the scene asks for, and why the rest is left out.
std::vector<Model> models_of(const Scene& scene);

// `mesh` is the scene's blocks before anything moves, or as its packing has them.
template <int dim>
CheckReport check_scene(const Scene& scene, const mesh::BlockMesh<dim>& mesh);

std::string to_text(const CheckReport& report);

}  // namespace scree
