#include <fmt/format.h>

#include "tools/scene/sections.h"

namespace scree {

namespace {

struct ShapeInPlace {
  mesh::Shape shape;
  Pose pose;
  SourceLocation where;
};

void check_file(const Checked& file, Problems& problems) {
  std::error_code ignored;
  if (!file.sound || std::filesystem::is_regular_file(file.text, ignored)) return;
  problems.push_back(file.problem(file.text, "must be a file that exists"));
}

mesh::Shape read_shape(const std::string& kind, const Checked& shape, Problems& problems) {
  if (kind == "box") return mesh::Box{shape.at("size").vector()};
  if (kind == "sphere") return mesh::Sphere{shape.at("diameter").number()};
  if (kind == "cylinder") return mesh::Cylinder{shape.at("diameter").number(), shape.at("height").number()};
  check_file(shape.at("file"), problems);
  return mesh::MeshFile{shape.at("file").text, shape.at("scale").number()};
}

ShapeInPlace read_placed_shape(const Checked& body, int dimension, Problems& problems) {
  for (const CheckedEntry& entry : body.entries) {
    if (entry.value.key->choice != "shape") continue;
    const Checked& shape = entry.value;
    const Checked* place = shape.find(entry.name == "mesh" ? "position" : "centre");
    const Pose pose{place == nullptr ? Eigen::Vector3d::Zero() : place->vector(),
                    read_rotation(shape.find("rotation"), dimension, problems)};
    return {read_shape(entry.name, shape, problems), pose, entry.where};
  }
  return {mesh::Box{}, Pose{}, body.where};
}

mesh::Arrangement read_lattice(const Checked& lattice, int dimension, Problems& problems) {
  mesh::OnLattice result;
  result.centre = lattice.at("centre").vector();
  result.spacing = lattice.at("spacing").vector();
  result.rotation = read_rotation(lattice.find("rotation"), dimension, problems);
  const Checked& count = lattice.at("count");
  double copies = 1;
  for (std::size_t i = 0; i < count.numbers.size(); ++i) {
    result.count[i] = static_cast<int>(count.numbers[i]);
    copies *= count.numbers[i];
  }
  constexpr double most = 1e7;  // as many as `random` takes
  if (copies > most) problems.push_back(count.problem(fmt::format("{:g} copies", copies), "must be at most 10 million in all"));
  return result;
}

mesh::Arrangement read_random(const Checked& random, int dimension, Problems& problems) {
  check_corners(random, Flat::refused, dimension, problems);
  return mesh::AtRandom{.count = random.at("count").integer(),
                        .low = random.at("low").vector(),
                        .high = random.at("high").vector(),
                        .seed = static_cast<std::uint64_t>(random.at("seed").number()),
                        .random_rotation = random.at("rotate").flag()};
}

mesh::Arrangement read_arrangement(const Checked& body, const Pose& single, int dimension, Problems& problems) {
  if (const Checked* lattice = body.find("lattice")) return read_lattice(*lattice, dimension, problems);
  if (const Checked* random = body.find("random")) return read_random(*random, dimension, problems);
  const Checked* at = body.find("at");
  if (at == nullptr) return mesh::AtPoses{{single}};
  mesh::AtPoses poses;
  poses.poses.clear();
  for (const Checked& copy : at->items) {
    poses.poses.push_back({copy.at("position").vector(), read_rotation(copy.find("rotation"), dimension, problems)});
  }
  return poses;
}

// Nothing for simplices.
std::optional<mesh::CellKind> cells_of(const std::string& word) {
  for (const auto kind : {mesh::CellKind::quadrilateral, mesh::CellKind::wedge, mesh::CellKind::hexahedron}) {
    if (word == mesh::kind_name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace

std::vector<mesh::BodySpec> read_bodies(const Checked& scene, int dimension, Problems& problems) {
  const std::vector<std::string> materials = names_of(scene.at("materials"));
  std::vector<mesh::BodySpec> bodies;
  for (const CheckedEntry& entry : scene.at("bodies").entries) {
    const Checked& body = entry.value;
    const ShapeInPlace placed = read_placed_shape(body, dimension, problems);
    mesh::BodySpec spec;
    spec.name = entry.name;
    spec.shape = placed.shape;
    spec.arrangement = read_arrangement(body, placed.pose, dimension, problems);
    spec.mesh_size = body.at("mesh_size").number();
    if (const Checked* elements = body.find("elements")) spec.cells = cells_of(elements->text);
    spec.blocks = body.at("blocks").text == "per_element" ? mesh::BlockRule::per_element : mesh::BlockRule::whole;
    spec.material = resolve<MaterialId>(body.at("material"), materials, "material", problems);
    spec.fixed = body.at("fixed").flag();
    spec.velocity = body.at("velocity").vector();
    spec.where = placed.where;
    bodies.push_back(std::move(spec));
  }
  return bodies;
}

}  // namespace scree
