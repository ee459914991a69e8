#include "tests/mesh/sample_files.h"

#include <fstream>

#include <fmt/format.h>
#include <gmsh.h>

#include "tests/mesh/body_builders.h"

namespace scree::mesh {

std::string msh_text(const Points& points, const std::vector<FileCell>& cells) {
  // One curve, surface and volume without bounds, as carriers of the elements.
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 1 1 1\n";
  for (int dimension = 1; dimension <= 3; ++dimension) text += "1 0 0 0 1 1 1 0 0\n";
  text += "$EndEntities\n$Nodes\n";
  text += fmt::format("1 {0} 1 {0}\n3 1 0 {0}\n", points.size());
  for (std::size_t i = 1; i <= points.size(); ++i) text += fmt::format("{}\n", i);
  for (const auto& [x, y, z] : points) text += fmt::format("{} {} {}\n", x, y, z);
  text += fmt::format("$EndNodes\n$Elements\n{0} {0} 1 {0}\n", cells.size());
  int number = 1;
  for (const FileCell& cell : cells) {
    const int dimension = cell.kind == Kind::line ? 1 : cell.kind <= Kind::quadrangle ? 2 : 3;
    text += fmt::format("{} 1 {} 1\n{}", dimension, static_cast<int>(cell.kind), number++);
    for (const int node : cell.nodes) text += fmt::format(" {}", node);
    text += "\n";
  }
  return text + "$EndElements\n";
}

Points cube_points(double low) {
  Points points;
  for (int i = 0; i < 8; ++i) points.push_back({low + (i & 1), low + ((i >> 1) & 1), low + (i >> 2)});
  return points;
}

std::vector<FileCell> cube_triangles(int first_node) {
  const std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  std::vector<FileCell> cells;
  for (const auto& [a, b, c, d] : faces) {
    cells.push_back({Kind::triangle, {first_node + a, first_node + b, first_node + c}});
    cells.push_back({Kind::triangle, {first_node + a, first_node + c, first_node + d}});
  }
  return cells;
}

void write_box(const std::filesystem::path& file, bool binary) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
  gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
  gmsh::model::occ::synchronize();
  gmsh::model::mesh::generate(3);
  gmsh::write(file.string());
  gmsh::finalize();
}

void write_box_with_groups(const std::filesystem::path& file, int dimension) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  if (dimension == 3) {
    gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
  } else {
    gmsh::model::occ::addRectangle(0, 0, 0, 1, 2);
  }
  gmsh::model::occ::synchronize();
  const double e = 1e-3, height = dimension == 3 ? 3 : 2;
  const auto group = [&](double low, double high, int tag) {
    gmsh::vectorpair found;
    const Eigen::Vector3d from = dimension == 3 ? Eigen::Vector3d(-e, -e, low - e) : Eigen::Vector3d(-e, low - e, -e);
    const Eigen::Vector3d to = dimension == 3 ? Eigen::Vector3d(1 + e, 2 + e, high + e) : Eigen::Vector3d(1 + e, high + e, e);
    gmsh::model::getEntitiesInBoundingBox(from.x(), from.y(), from.z(), to.x(), to.y(), to.z(), found, dimension - 1);
    gmsh::model::addPhysicalGroup(dimension - 1, {found.at(0).second}, tag);
  };
  group(0, 0, 3);
  gmsh::model::setPhysicalName(dimension - 1, 3, "ground");
  group(height, height, 7);
  gmsh::model::addPhysicalGroup(dimension, {1}, 1);
  gmsh::model::mesh::generate(dimension);
  gmsh::write(file.string());
  gmsh::finalize();
}

BodySpec MeshFileTest::body_with(const std::string& name, const std::string& text, double mesh_size) {
  const std::filesystem::path file = directory_ / name;
  if (!text.empty()) std::ofstream(file, std::ios::binary) << text;
  return body_of(MeshFile{file}, mesh_size);
}

template <int dim>
std::string MeshFileTest::refusal(const std::string& name, const std::string& text, double mesh_size) {
  const BodySpec body = body_with(name, text, mesh_size);
  const std::string message = input_error([&] { make_blocks<dim>({body}); });
  const std::string start = "scene.yaml:4:10: bodies.stone.mesh.file is " + (directory_ / name).string() + " ";
  EXPECT_TRUE(message.starts_with(start)) << message;
  return message.substr(std::min(start.size(), message.size()));
}

template std::string MeshFileTest::refusal<2>(const std::string&, const std::string&, double);
template std::string MeshFileTest::refusal<3>(const std::string&, const std::string&, double);

}  // namespace scree::mesh
