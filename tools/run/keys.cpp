#include "tools/run/keys.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/hash.h"
#include "engine/base/version.h"

namespace scree::run {

namespace {

// The lines of a section of the effective scene, or none if it has no such section. Only names of sections begin a line with a
// letter there: all else is indented. To parse it and to write a part of it again takes a tenth of a small run.
std::string_view section_of(std::string_view effective, std::string_view name) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t begin = 0; begin < effective.size();) {
    std::size_t end = begin;
    do {
      end = std::min(effective.find('\n', end), effective.size() - 1) + 1;
    } while (end < effective.size() && !is_letter(effective[end]));
    const std::string_view section = effective.substr(begin, end - begin);
    if (section.starts_with(name) && section.substr(name.size()).starts_with(':')) return section;
    begin = end;
  }
  return {};
}

// The effective scene is written with every default filled in and in a fixed order, so its text tells what a section means.
void add_sections(Hasher& hash, const Scene& scene, std::initializer_list<std::string_view> sections) {
  for (const std::string_view section : sections) hash.add(section_of(scene.effective, section));
}

void add(Hasher& hash, const std::optional<double>& value) {
  hash.add(value.has_value());
  hash.add(value.value_or(0.0));
}

template <int dim>
void add_mesh(Hasher& hash, const mesh::BlockMesh<dim>& mesh) {
  hash.add(dim);
  const auto add_all = [&hash](const auto& table) { hash.add_bytes(table.raw().data(), table.size() * sizeof table.raw()[0]); };
  static_assert(sizeof(Point<dim>) == dim * sizeof(double) && sizeof mesh.elements.raw()[0] == (dim + 1) * sizeof(int));
  add_all(mesh.nodes);
  add_all(mesh.elements);
  for (const mesh::Cell& cell : mesh.cells) {
    hash.add(static_cast<int>(cell.kind));
    for (const NodeId node : cell.nodes) hash.add(node.value());
  }
  for (const mesh::Block& block : mesh.blocks) {
    hash.add(block.body.value()).add(block.nodes.size()).add(block.elements.size());
    hash.add_bytes(block.orientation.coeffs().data(), sizeof(double) * 4);
  }
  for (const mesh::Body& body : mesh.bodies) {
    hash.add(body.name).add(body.material.value()).add(body.fixed);
    hash.add_bytes(body.velocity.data(), sizeof(double) * 3);
  }
  for (const mesh::NamedSurface& surface : mesh.surface_names) hash.add(surface.body.value()).add(surface.name);
  for (const auto& face : mesh.surfaces) {
    for (const NodeId node : face.nodes) hash.add(node.value());
    hash.add(face.surface.value());
  }
}

// A file that is not there counts as an empty one; whoever reads it will complain.
void add_content(Hasher& hash, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  hash.add(std::string(std::istreambuf_iterator<char>(stream), {}));
}

// The content of the tables the scene names.
void add_tables(Hasher& hash, const Scene& scene) {
  for (const std::filesystem::path& table : scene.tables) add_content(hash, table);
}

void add_frame(Hasher& hash, const output::StoredField& stored) {
  try {
    add_content(hash, output::stored_frame(stored));
  } catch (const InputError&) {
    hash.add(false);  // the run will complain
  }
}

void add_mesh_files(Hasher& hash, const Scene& scene) {
  for (const mesh::BodySpec& body : scene.bodies) {
    if (const auto* file = std::get_if<mesh::MeshFile>(&body.shape)) add_content(hash, file->path);
  }
}

void add_fall(Hasher& hash, const Scene& scene) {
  for (const Material& material : scene.materials) {
    add(hash, material.density);
    hash.add(material.friction).add(material.restitution);
  }
  // All but what the fall is judged by.
  std::istringstream lines{std::string(section_of(scene.effective, "settle"))};
  for (std::string line; std::getline(lines, line);) {
    const std::string_view key = std::string_view(line).substr(std::min(line.size(), line.find_first_not_of(' ')));
    if (!key.starts_with("accept_moving:") && !key.starts_with("largest_overlap:")) hash.add(line);
  }
}

}  // namespace

template <int dim>
std::string packing_key(const Scene& scene, const mesh::BlockMesh<dim>& mesh) {
  Hasher hash;
  hash.add("packing").add(version());
  add_mesh(hash, mesh);
  add_fall(hash, scene);
  return hash.hex();
}

std::string fall_key(const Scene& scene) {
  Hasher hash;
  hash.add("fall").add(version());
  add_sections(hash, scene, {"bodies"});
  add_mesh_files(hash, scene);
  add_fall(hash, scene);
  return hash.hex();
}

std::string run_key(const Scene& scene, bool space_errors) {
  Hasher hash;
  hash.add("run").add(version()).add(scene.effective).add(space_errors);
  add_tables(hash, scene);
  add_mesh_files(hash, scene);
  if (scene.packing) add_content(hash, *scene.packing);
  if (scene.initial_field) add_frame(hash, *scene.initial_field);
  return hash.hex();
}

void expect_planned(const Scene& scene, const std::string& key, bool space_errors) {
  if (run_key(scene, space_errors) == key) return;
  throw RunError(fmt::format("{}: it, or a file that it names, has changed since this run was planned. Call the study again",
                             scene.file.string()));
}

template <int dim>
std::string heat_key(const Scene& scene, const packing::Packing<dim>& packing, const Eigen::VectorXd* start) {
  Hasher hash;
  hash.add("heat").add(version());
  add_mesh(hash, packing.mesh);
  for (const Pose& pose : packing.poses) {
    hash.add_bytes(pose.translation.data(), sizeof(double) * 3);
    hash.add_bytes(pose.rotation.coeffs().data(), sizeof(double) * 4);
  }
  add_sections(hash, scene, {"materials", "contact", "heat", "output"});
  add_tables(hash, scene);
  if (start != nullptr) hash.add_bytes(start->data(), sizeof(double) * static_cast<std::size_t>(start->size()));
  return hash.hex();
}

std::string scene_hash(const Scene& scene) {
  return Hasher{}.add(scene.effective).hex();
}

template std::string packing_key<2>(const Scene&, const mesh::BlockMesh<2>&);
template std::string packing_key<3>(const Scene&, const mesh::BlockMesh<3>&);
template std::string heat_key<2>(const Scene&, const packing::Packing<2>&, const Eigen::VectorXd*);
template std::string heat_key<3>(const Scene&, const packing::Packing<3>&, const Eigen::VectorXd*);

}  // namespace scree::run
