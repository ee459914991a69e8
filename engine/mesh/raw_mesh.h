// A mesh as a file holds it, before anything is known about its soundness.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/mesh/cell_kind.h"

namespace scree::mesh {

template <int corners>
struct RawCell {
  std::size_t number = 0;  // as the file counts, for messages
  std::array<std::size_t, corners> nodes{};
};

// A quadrilateral, wedge or hexahedron.
struct RawLargeCell {
  CellKind kind = CellKind::hexahedron;
  std::size_t number = 0;
  std::array<std::size_t, 8> nodes{};  // as many as it has corners
};

// The faces of a physical group: lines if its dimension is 1, triangles and quadrilaterals if it is 2.
struct RawSurface {
  std::string name;
  int dimension = 2;
  std::vector<std::vector<std::size_t>> faces;  // their nodes
};

struct RawMesh {
  std::vector<Eigen::Vector3d> points;     // in the file's unit
  std::vector<std::size_t> point_numbers;  // as the file counts, for messages
  std::vector<std::size_t> marked;         // points of point and line elements, which are otherwise left out
  std::vector<RawCell<3>> triangles;
  std::vector<RawCell<4>> tetrahedra;
  std::vector<RawLargeCell> cells;
  std::vector<RawSurface> surfaces;
  std::map<std::string, std::size_t> unusable;  // any other kind of element, with its count
};

// Reads one kind of file. Throws std::runtime_error with the reason, in words, if the file cannot be understood.
using MeshReader = std::function<RawMesh(const std::filesystem::path&)>;

// Readers by extension in lower case, such as ".vtu".
using MeshReaders = std::map<std::string, MeshReader>;

}  // namespace scree::mesh
