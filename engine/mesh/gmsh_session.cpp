#include "engine/mesh/gmsh_session.h"

#include <algorithm>
#include <clocale>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "engine/base/threads.h"

namespace scree::mesh {

namespace {

// Element types of Gmsh's API.
constexpr int line = 1, triangle = 2, quadrangle = 3, tetrahedron = 4, hexahedron = 5, prism = 6, point = 15;

class Session {
 public:
  Session() {
    gmsh::initialize();
    gmsh::set_number("General.Terminal", 0);
    gmsh::set_number("General.NumThreads", 1);
    gmsh::set_number("Mesh.RandomSeed", 1);
  }
  ~Session() {
    try {
      gmsh::finalize();
    } catch (const GmshFailure&) {  // of a session that is over
    }
    use_threads(threads_);
    std::setlocale(LC_ALL, locale_.c_str());
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  // What Gmsh sets to its own: the threads for all loops of this thread, and the locale of the process.
  int threads_ = threads_in_use();
  std::string locale_ = std::setlocale(LC_ALL, nullptr);
};

template <int corners>
std::vector<RawCell<corners>> cells(const std::vector<std::size_t>& numbers, const std::vector<std::size_t>& nodes,
                                    const std::unordered_map<std::size_t, std::size_t>& index) {
  std::vector<RawCell<corners>> made(numbers.size());
  for (std::size_t e = 0; e < numbers.size(); ++e) {
    made[e].number = numbers[e];
    for (int i = 0; i < corners; ++i) made[e].nodes[i] = index.at(nodes[corners * e + i]);
  }
  return made;
}

void add_large_cells(CellKind kind, const std::vector<std::size_t>& numbers, const std::vector<std::size_t>& nodes,
                     const std::unordered_map<std::size_t, std::size_t>& index, RawMesh& mesh) {
  const std::size_t corners = corner_count(kind);
  for (std::size_t e = 0; e < numbers.size(); ++e) {
    RawLargeCell& cell = mesh.cells.emplace_back(RawLargeCell{kind, numbers[e], {}});
    for (std::size_t i = 0; i < corners; ++i) cell.nodes[i] = index.at(nodes[corners * e + i]);
  }
}

void add_elements(const gmsh::Elements& elements, const std::unordered_map<std::size_t, std::size_t>& index, RawMesh& mesh) {
  const auto& [type, tags, nodes] = elements;
  if (type == tetrahedron) {
    mesh.tetrahedra = cells<4>(tags, nodes, index);
  } else if (type == triangle) {
    mesh.triangles = cells<3>(tags, nodes, index);
  } else if (type == line || type == point) {
    for (const std::size_t node : nodes) mesh.marked.push_back(index.at(node));
  } else if (type == quadrangle) {
    add_large_cells(CellKind::quadrilateral, tags, nodes, index, mesh);
  } else if (type == prism) {
    add_large_cells(CellKind::wedge, tags, nodes, index, mesh);
  } else if (type == hexahedron) {
    add_large_cells(CellKind::hexahedron, tags, nodes, index, mesh);
  } else {
    mesh.unusable[gmsh::element_name(type)] += tags.size();
  }
}

// The faces of one of Gmsh's entities.
void add_faces(int dimension, int entity, const std::unordered_map<std::size_t, std::size_t>& index, RawSurface& surface) {
  for (const gmsh::Elements& elements : gmsh::elements(dimension, entity)) {
    const std::size_t corners = elements.nodes.size() / std::max<std::size_t>(1, elements.tags.size());
    for (std::size_t i = 0; i < elements.nodes.size(); ++i) {
      if (i % corners == 0) surface.faces.emplace_back();
      surface.faces.back().push_back(index.at(elements.nodes[i]));
    }
  }
}

// The physical groups of curves and faces; one without a name is called by its number.
// By their names, or their numbers where they have none or that of an earlier one.
std::vector<RawSurface> physical_groups(const std::unordered_map<std::size_t, std::size_t>& index) {
  std::vector<RawSurface> surfaces;
  std::set<std::pair<int, std::string>> names;  // by dimension
  for (const gmsh::PhysicalGroup& group : gmsh::physical_groups()) {
    if (group.dimension != 1 && group.dimension != 2) continue;
    RawSurface surface;
    surface.dimension = group.dimension;
    surface.name = gmsh::physical_name(group);
    const auto is_taken = [&](const std::string& name) { return !names.insert({group.dimension, name}).second; };
    if (surface.name.empty() || is_taken(surface.name)) {
      surface.name = std::to_string(group.tag);
      if (is_taken(surface.name)) throw std::runtime_error("two physical groups have the name " + surface.name);
    }
    for (const int entity : gmsh::entities_of(group)) add_faces(group.dimension, entity, index, surface);
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace

void with_gmsh(const std::function<void()>& work) {
  const Session session;
  work();
}

void generate(int dimension, double mesh_size, FaceMesher faces) {
  gmsh::set_number("Mesh.MeshSizeMin", mesh_size);
  gmsh::set_number("Mesh.MeshSizeMax", mesh_size);
  gmsh::set_number("Mesh.MeshSizeFromPoints", 0);
  gmsh::set_number("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::set_number("Mesh.Algorithm", static_cast<double>(faces));
  // Delaunay. HXT (10) makes slightly better tetrahedra, but not the same ones twice.
  gmsh::set_number("Mesh.Algorithm3D", 1);
  // The built-in optimiser works on tetrahedra below this quality; the figures behind 0.5 are in README.md.
  gmsh::set_number("Mesh.Optimize", 1);
  gmsh::set_number("Mesh.OptimizeThreshold", 0.5);
  gmsh::generate(dimension);
}

void only_quadrilaterals() {
  gmsh::set_number("Mesh.RecombineAll", 1);
  gmsh::set_number("Mesh.RecombinationAlgorithm", 3);  // blossom, all quadrilaterals
}

RawMesh model_mesh() {
  RawMesh mesh;
  gmsh::Nodes nodes = gmsh::nodes();
  mesh.point_numbers = std::move(nodes.tags);
  std::unordered_map<std::size_t, std::size_t> index;
  for (std::size_t i = 0; i < mesh.point_numbers.size(); ++i) {
    index[mesh.point_numbers[i]] = i;
    mesh.points.emplace_back(nodes.coordinates[3 * i], nodes.coordinates[3 * i + 1], nodes.coordinates[3 * i + 2]);
  }
  for (const gmsh::Elements& elements : gmsh::elements()) add_elements(elements, index, mesh);
  mesh.surfaces = physical_groups(index);
  return mesh;
}

}  // namespace scree::mesh
