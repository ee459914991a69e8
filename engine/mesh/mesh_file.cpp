#include "engine/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/scratch_folder.h"
#include "engine/mesh/closed_surface.h"
#include "engine/mesh/gmsh_session.h"
#include "engine/mesh/point_checks.h"
#include "engine/mesh/problems.h"
#include "engine/mesh/split_cells.h"
#include "engine/mesh/volume_mesh.h"

namespace scree::mesh {

namespace {

// Gmsh runs whatever is no mesh by its name or its beginning as a script of its own language, which can start programs, and
// FILE.opt beside a mesh, too. So it is shown nothing else, by a name of ours in a folder where nothing else is.
void expect_mesh_format(const std::filesystem::path& path) {
  constexpr std::string_view expected = "$MeshFormat";
  std::string start(expected.size(), '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != expected) throw std::runtime_error("it does not begin with $MeshFormat");
}

// Of a binary .stl file: a head of 80 bytes, the number of triangles and 50 bytes of each, three numbers for its normal and
// nine for its corners. Gmsh takes a corner that is no number for another one, and a part of the surface is gone.
void expect_numbers_of(std::ifstream& file, std::uint32_t triangles) {
  std::array<char, 50> record{};
  for (std::uint32_t number = 1; number <= triangles && file.read(record.data(), record.size()); ++number) {
    std::array<float, 12> values{};
    std::memcpy(values.data(), record.data(), sizeof values);
    if (std::all_of(values.begin() + 3, values.end(), [](float value) { return std::isfinite(value); })) continue;
    throw std::runtime_error(fmt::format("a corner of its triangle {} is no number", number));
  }
}

// The triangles of a binary .stl file, whose size tells it from one of text.
std::optional<std::uint32_t> binary_triangles(std::ifstream& file, std::uintmax_t size) {
  constexpr std::uintmax_t head = 80;
  std::uint32_t triangles = 0;
  file.seekg(head);
  const bool read = static_cast<bool>(file.read(reinterpret_cast<char*>(&triangles), sizeof triangles));
  if (read && size == head + sizeof triangles + std::uintmax_t{50} * triangles) return triangles;
  file.clear();
  file.seekg(0);
  return std::nullopt;
}

// A vertex that is no number ends Gmsh by an assertion, or is lost.
void expect_numbers(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (const auto triangles = binary_triangles(file, std::filesystem::file_size(path))) {
    return expect_numbers_of(file, *triangles);
  }
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::transform(line.begin(), line.end(), line.begin(), [](unsigned char c) { return std::tolower(c); });
    const std::size_t word = line.find_first_not_of(" \t");
    if (word == std::string::npos || line.compare(word, 6, "vertex") != 0) continue;
    if (line.find("nan", word + 6) == std::string::npos) continue;
    throw std::runtime_error(fmt::format("a coordinate in its line {} is no number", number));
  }
}

RawMesh read_by_gmsh(const std::filesystem::path& path, const std::string& extension) {
  const ScratchFolder folder;
  const std::filesystem::path shown = folder.path() / ("mesh" + extension);
  std::filesystem::create_symlink(std::filesystem::absolute(path), shown);
  RawMesh raw;
  with_gmsh([&] {
    gmsh::open(shown.string());
    raw = model_mesh();
  });
  return raw;
}

MeshReaders all_readers(const MeshReaders& more) {
  MeshReaders readers = more;
  readers[".stl"] = [](const std::filesystem::path& path) {
    expect_numbers(path);
    return read_by_gmsh(path, ".stl");
  };
  readers[".msh"] = [](const std::filesystem::path& path) {
    expect_mesh_format(path);
    return read_by_gmsh(path, ".msh");
  };
  return readers;
}

RawMesh read_raw(const BodySpec& body, const MeshReaders& more) {
  const std::filesystem::path& path = std::get<MeshFile>(body.shape).path;
  const MeshReaders readers = all_readers(more);
  const std::string extension = extension_of(std::get<MeshFile>(body.shape));
  const auto reader = readers.find(extension);
  if (reader == readers.end()) {
    std::vector<std::string> known;
    for (const auto& [name, ignored] : readers) known.push_back(name);
    throw file_error(body, fmt::format("must be one of {}", fmt::join(known, ", ")),
                     "Convert the mesh, for instance with Gmsh");
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw file_error(body, "no such file", "A relative path counts from the scene's folder");
  }
  if (!std::ifstream(path, std::ios::binary)) {
    throw file_error(body, fmt::format("must be a file that can be read ({})", std::strerror(errno)),
                     "Look at its permissions");
  }
  const auto damaged = [&](const std::string& reason) {
    return file_error(body, fmt::format("must be a whole {} mesh; it cannot be read: {}", extension, reason),
                      "Export it again");
  };
  try {
    return reader->second(path);
  } catch (const RunError&) {
    throw;  // it is not the file's fault
  } catch (const GmshFailure& failure) {
    throw damaged(failure.reason);
  } catch (const std::runtime_error& failure) {
    throw damaged(failure.what());
  }
}

void expect_known_kinds(const BodySpec& body, const RawMesh& raw) {
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : raw.unusable) kinds.push_back(fmt::format("{} x {}", count, kind));
  if (kinds.empty()) return;
  throw file_error(body, fmt::format("must hold elements of first order and no pyramids; it holds {}", fmt::join(kinds, ", ")),
                   "Mesh the shape with tetrahedra, wedges or hexahedra of first order");
}

void expect_in_plane(const BodySpec& body, const RawMesh& raw) {
  const auto off = std::find_if(raw.points.begin(), raw.points.end(), [](const auto& point) { return point.z() != 0; });
  if (raw.tetrahedra.empty() && off == raw.points.end()) return;
  throw file_error(body, "a scene in 2-D takes triangles or quadrilaterals in the plane z = 0",
                   "Use a plane mesh, or `dimension: 3`");
}

}  // namespace

std::string extension_of(const MeshFile& file) {
  std::string extension = file.path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

template <int dim>
Parts<dim> mesh_file(const BodySpec& body, const MeshReaders& readers) {
  RawMesh raw = read_raw(body, readers);
  for (Eigen::Vector3d& point : raw.points) point *= std::get<MeshFile>(body.shape).scale;
  expect_known_kinds(body, raw);
  if (raw.triangles.empty() && raw.tetrahedra.empty() && raw.cells.empty()) {
    throw file_error(body, "it holds no elements with an area or a volume", "Export the mesh with its elements");
  }
  check_points(body, raw);
  raw.surfaces.erase(std::remove_if(raw.surfaces.begin(), raw.surfaces.end(),
                                    [](const RawSurface& surface) { return surface.dimension != dim - 1; }),
                     raw.surfaces.end());
  split_cells<dim>(body, raw);
  if constexpr (dim == 2) {
    expect_in_plane(body, raw);
  } else if (raw.tetrahedra.empty()) {
    return fill_surface(body, std::move(raw));
  }
  return checked_volume<dim>(body, raw);
}

template Parts<2> mesh_file<2>(const BodySpec&, const MeshReaders&);
template Parts<3> mesh_file<3>(const BodySpec&, const MeshReaders&);

}  // namespace scree::mesh
