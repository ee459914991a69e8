// Small meshes for the tests of the output.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "engine/mesh/block_mesh.h"
#include "tests/temp_folder.h"

namespace scree::output {

using test::TempFolder;

inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Adds a block of one element.
template <int dim>
void add_block(mesh::BlockMesh<dim>& mesh, BodyId body, const std::array<Point<dim>, dim + 1>& corners) {
  const std::size_t node = mesh.nodes.size();
  const std::size_t element = mesh.elements.size();
  typename mesh::BlockMesh<dim>::Element nodes;
  for (int i = 0; i <= dim; ++i) nodes[i] = mesh.nodes.push_back(corners[i]);
  mesh.elements.push_back(nodes);
  mesh.blocks.push_back({body, {node, node + dim + 1}, {element, element + 1}});
}

inline std::array<Point<3>, 4> unit_tet(const Point<3>& at = Point<3>::Zero()) {
  return {at, at + Point<3>::UnitX(), at + Point<3>::UnitY(), at + Point<3>::UnitZ()};
}

}  // namespace scree::output
