// What a scene asks the mesher for. Shapes are centred on their own origin; a placement moves them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/geometry.h"
#include "engine/base/ids.h"
#include "engine/mesh/cell_kind.h"

namespace scree::mesh {

struct Box {                                       // a rectangle in 2-D (size z unused)
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  // edge lengths [m]
  friend bool operator==(const Box&, const Box&) = default;
};
struct Sphere {         // a disc in 2-D
  double diameter = 0;  // [m]
  friend bool operator==(const Sphere&, const Sphere&) = default;
};
struct Cylinder {       // axis along z; 3-D only
  double diameter = 0;  // [m]
  double height = 0;    // [m]
  friend bool operator==(const Cylinder&, const Cylinder&) = default;
};
// A closed surface (.stl, .msh, .vtu) or a volume mesh (Gmsh .msh 4, .vtu), in the file's own coordinates; a surface is
// meshed inside with the body's mesh_size, a volume mesh is used as it is.
struct MeshFile {
  std::filesystem::path path;
  double scale = 1;  // metres per unit of the file
  friend bool operator==(const MeshFile&, const MeshFile&) = default;
};
using Shape = std::variant<Box, Sphere, Cylinder, MeshFile>;

enum class BlockRule { whole, per_element };

// Copies of the shape at given poses.
struct AtPoses {
  std::vector<Pose> poses{Pose{}};
};
// count[0] x count[1] x count[2] copies, centred on `centre`.
struct OnLattice {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // [m]
  std::array<int, 3> count{1, 1, 1};
  Eigen::Vector3d spacing = Eigen::Vector3d::Zero();             // centre to centre [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // of each copy
};
// `count` copies with centres drawn in a box so that no two bounding spheres overlap.
struct AtRandom {
  int count = 1;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  // corners of the region that holds the copies whole [m]
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  std::uint64_t seed = 1;
  bool random_rotation = true;
};
using Arrangement = std::variant<AtPoses, OnLattice, AtRandom>;

struct BodySpec {
  std::string name;
  Shape shape;
  Arrangement arrangement = AtPoses{};
  double mesh_size = 0;           // target edge length [m]
  std::optional<CellKind> cells;  // what a shape is meshed with; nothing: simplices. A mesh file has its own
  BlockRule blocks = BlockRule::whole;
  MaterialId material;
  bool fixed = false;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // at the start [m/s]
  SourceLocation where;                                // of the shape in the scene, for messages
};

}  // namespace scree::mesh
