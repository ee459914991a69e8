// Bodies and measures for the mesher's tests.
#pragma once

#include <string>
#include <utility>

#include "engine/mesh/make_blocks.h"

namespace scree::mesh {

inline BodySpec body_of(Shape shape, double mesh_size, BlockRule blocks = BlockRule::whole) {
  BodySpec body;
  body.name = "stone";
  body.shape = std::move(shape);
  body.mesh_size = mesh_size;
  body.blocks = blocks;
  body.where = {"scene.yaml", 4, 10};
  return body;
}

inline Box box_of(double x, double y, double z) {
  return Box{.size = {x, y, z}};
}

template <int dim>
double total_volume(const BlockMesh<dim>& mesh) {
  double sum = 0;
  for (const ElementId e : mesh.elements.ids()) sum += element_volume(mesh, e);
  return sum;
}

// The text of the InputError that `work` throws; empty if it throws none.
template <class Work>
std::string input_error(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace scree::mesh
