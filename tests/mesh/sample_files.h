// Mesh files for the tests, good and bad ones.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/mesh/body_spec.h"
#include "tests/temp_folder.h"

namespace scree::mesh {

// Element types as Gmsh numbers them.
enum class Kind { line = 1, triangle = 2, quadrangle = 3, tetrahedron = 4, hexahedron = 5, wedge = 6, pyramid = 7 };

struct FileCell {
  Kind kind;
  std::vector<int> nodes;  // counted from 1
};

using Points = std::vector<std::array<double, 3>>;

// MSH 4.1 in text. Nodes and elements are numbered from 1.
std::string msh_text(const Points& points, const std::vector<FileCell>& cells);

// The eight corners of a unit cube at `low`, and its surface in twelve triangles that face outwards.
Points cube_points(double low = 0);
std::vector<FileCell> cube_triangles(int first_node = 1);

// A 1 x 2 x 3 box of tetrahedra about 0.5 long (.msh) or its surface (.stl), written by Gmsh.
void write_box(const std::filesystem::path& file, bool binary);

// The same box with its elements in a physical group, its lowest face in one called "ground", its highest in one without a
// name, number 7; in 2-D the rectangle of that size with its lower and upper edges.
void write_box_with_groups(const std::filesystem::path& file, int dimension);

// A test with a directory of its own, gone afterwards.
class MeshFileTest : public testing::Test {
 protected:
  // Writes `text` to a file and gives the body made of it.
  BodySpec body_with(const std::string& name, const std::string& text, double mesh_size = 1);
  // The text that refuses such a body, without the place, the key and the path it begins with.
  template <int dim = 3>
  std::string refusal(const std::string& name, const std::string& text, double mesh_size = 1);

  test::TempFolder folder_;
  const std::filesystem::path& directory_ = folder_.path();
};

}  // namespace scree::mesh
