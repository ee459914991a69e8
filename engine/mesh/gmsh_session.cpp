#include "engine/mesh/gmsh_session.h"

#include <algorithm>
#include <unordered_map>

#include <gmsh.h>

namespace scree::mesh {

namespace {

// Element types of Gmsh's API.
constexpr int line = 1, triangle = 2, quadrangle = 3, tetrahedron = 4, hexahedron = 5, prism = 6, point = 15;

class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.RandomSeed", 1);
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

std::string last_error(const std::string& thrown) {
  std::string reason;
  gmsh::logger::getLastError(reason);
  return reason.empty() ? thrown : reason;
}

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

std::string gmsh_name(int type) {
  std::string name;
  int dimension = 0, order = 0, nodes = 0, primary = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, local, primary);
  return name;
}

// The faces of one of Gmsh's entities.
void add_faces(int dimension, int entity, const std::unordered_map<std::size_t, std::size_t>& index, RawSurface& surface) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> numbers, nodes;
  gmsh::model::mesh::getElements(types, numbers, nodes, dimension, entity);
  for (std::size_t t = 0; t < types.size(); ++t) {
    const std::size_t corners = nodes[t].size() / std::max<std::size_t>(1, numbers[t].size());
    for (std::size_t i = 0; i < nodes[t].size(); ++i) {
      if (i % corners == 0) surface.faces.emplace_back();
      surface.faces.back().push_back(index.at(nodes[t][i]));
    }
  }
}

// The physical groups of curves and faces; one without a name is called by its number.
std::vector<RawSurface> physical_groups(const std::unordered_map<std::size_t, std::size_t>& index) {
  std::vector<RawSurface> surfaces;
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    if (dimension != 1 && dimension != 2) continue;
    RawSurface surface;
    surface.dimension = dimension;
    gmsh::model::getPhysicalName(dimension, tag, surface.name);
    if (surface.name.empty()) surface.name = std::to_string(tag);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    for (const int entity : entities) add_faces(dimension, entity, index, surface);
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace

void with_gmsh(const std::function<void()>& work) {
  const Session session;
  // Gmsh 4.8 throws strings, and now and then a number.
  try {
    work();
  } catch (const std::string& thrown) {
    throw GmshFailure{last_error(thrown)};
  } catch (const char* thrown) {
    throw GmshFailure{last_error(thrown)};
  } catch (int) {
    throw GmshFailure{last_error("no reason given")};
  }
}

void generate(int dimension, double mesh_size, FaceMesher faces) {
  const auto set = [](const char* option, double value) { gmsh::option::setNumber(option, value); };
  set("Mesh.MeshSizeMin", mesh_size);
  set("Mesh.MeshSizeMax", mesh_size);
  set("Mesh.MeshSizeFromPoints", 0);
  set("Mesh.MeshSizeExtendFromBoundary", 0);
  set("Mesh.Algorithm", static_cast<double>(faces));
  // Delaunay. HXT (10) makes slightly better tetrahedra, but not the same ones twice.
  set("Mesh.Algorithm3D", 1);
  // The built-in optimiser works on tetrahedra below this quality; the figures behind 0.5 are in README.md.
  set("Mesh.Optimize", 1);
  set("Mesh.OptimizeThreshold", 0.5);
  gmsh::model::mesh::generate(dimension);
}

void only_quadrilaterals() {
  gmsh::option::setNumber("Mesh.RecombineAll", 1);
  gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 3);  // blossom, all quadrilaterals
}

RawMesh model_mesh() {
  RawMesh mesh;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getNodes(mesh.point_numbers, coordinates, parametric);
  std::unordered_map<std::size_t, std::size_t> index;
  for (std::size_t i = 0; i < mesh.point_numbers.size(); ++i) {
    index[mesh.point_numbers[i]] = i;
    mesh.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
  }
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> numbers, nodes;
  gmsh::model::mesh::getElements(types, numbers, nodes);
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (types[t] == tetrahedron) {
      mesh.tetrahedra = cells<4>(numbers[t], nodes[t], index);
    } else if (types[t] == triangle) {
      mesh.triangles = cells<3>(numbers[t], nodes[t], index);
    } else if (types[t] == line || types[t] == point) {
      for (const std::size_t node : nodes[t]) mesh.marked.push_back(index.at(node));
    } else if (types[t] == quadrangle) {
      add_large_cells(CellKind::quadrilateral, numbers[t], nodes[t], index, mesh);
    } else if (types[t] == prism) {
      add_large_cells(CellKind::wedge, numbers[t], nodes[t], index, mesh);
    } else if (types[t] == hexahedron) {
      add_large_cells(CellKind::hexahedron, numbers[t], nodes[t], index, mesh);
    } else {
      mesh.unusable[gmsh_name(types[t])] += numbers[t].size();
    }
  }
  mesh.surfaces = physical_groups(index);
  return mesh;
}

}  // namespace scree::mesh
