// What one frame of a series shows.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "engine/mesh/block_mesh.h"

namespace scree::output {

enum class CellType : std::uint8_t { vertex, line, triangle, quadrilateral, tetrahedron, wedge, hexahedron };

// Points and cells. 2-D data has z = 0.
struct Grid {
  std::vector<Eigen::Vector3d> points;     // [m]
  std::vector<CellType> types;             // of each cell
  std::vector<std::int32_t> connectivity;  // corners of cell 0, of cell 1, ...
  bool to_look_at = false;                 // whether points within a millionth of its extent are enough
};

// Values at the points or cells of a grid; the name is what the user sees. Units go into the name's documentation, SI.
struct Array {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>> values;
};

struct Frame {
  double time = 0;  // [s]
  std::vector<Array> points;
  std::vector<Array> cells;
};

// Block by block: its cells, or its elements if it has none.
template <int dim>
Grid make_grid(const mesh::BlockMesh<dim>& mesh);

}  // namespace scree::output
