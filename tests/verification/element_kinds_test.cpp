// Conduction in each kind of element: triangle, quadrilateral, tetrahedron, wedge, hexahedron; the last two and the second by
// the mixed discretisation of Li & Feng (2016).
#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/SparseCholesky>

#include "engine/mesh/cells.h"
#include "engine/mesh/make_blocks.h"
#include "tests/thermal/builders.h"
#include "thermal/fluxes.h"

namespace scree::thermal {
namespace {

using Kind = std::optional<mesh::CellKind>;

constexpr double conductivity = 1.7;  // [W/m/K]

template <int dim>
std::vector<Kind> kinds() {
  if constexpr (dim == 2) {
    return {std::nullopt, mesh::CellKind::quadrilateral};
  } else {
    return {std::nullopt, mesh::CellKind::wedge, mesh::CellKind::hexahedron};
  }
}

std::string name_of(const Kind& kind) {
  return kind ? mesh::kind_name(*kind) : "simplex";
}

// The unit cube or square about the origin.
template <int dim>
mesh::BlockMesh<dim> cube_of(const Kind& kind, double mesh_size) {
  mesh::BodySpec body;
  body.name = "cube";
  body.shape = mesh::Box{.size = Eigen::Vector3d::Ones()};
  body.mesh_size = mesh_size;
  body.cells = kind;
  body.material = MaterialId{0};
  return mesh::make_blocks<dim>({body});
}

// A heat capacity of 1 J/m3/K: a node's capacity is its volume.
Table<MaterialId, Material> unit_material() {
  Material material;
  material.name = "unit";
  material.density = 1.0;
  material.specific_heat = 1.0;
  material.conductivity = conductivity;
  return Table<MaterialId, Material>({material});
}

template <int dim>
HeatModel model_of(const mesh::BlockMesh<dim>& mesh) {
  return make_heat_model(mesh, unit_material(), {}, test::options_for(mesh, 300));
}

// Every node somewhere else, the outer ones too, so that the faces of cells are not plane.
template <int dim>
void shake(mesh::BlockMesh<dim>& mesh, double amplitude) {
  std::mt19937 generator(1);
  for (Point<dim>& node : mesh.nodes) {
    for (int i = 0; i < dim; ++i) node[i] += amplitude * (2.0 * static_cast<double>(generator()) / 4294967296.0 - 1);
  }
}

// A smooth map of the cube onto itself.
template <int dim>
void bend(mesh::BlockMesh<dim>& mesh) {
  for (Point<dim>& node : mesh.nodes) {
    double bump = 0.08;
    for (int i = 0; i < dim; ++i) bump *= std::cos(M_PI * node[i]);
    node += bump * Point<dim>::LinSpaced(1, 1.5);
  }
}

template <int dim>
Point<dim> area_vector(const mesh::BlockMesh<dim>& mesh, const mesh::Face<dim>& face) {
  const Point<dim> u = mesh.nodes[face.nodes[1]] - mesh.nodes[face.nodes[0]];
  if constexpr (dim == 2) {
    return {u.y(), -u.x()};
  } else {
    return 0.5 * u.cross(mesh.nodes[face.nodes[2]] - mesh.nodes[face.nodes[0]]);
  }
}

// Every node's balance, with what a linear field brings in through the surface, in a mesh without a plane face.
template <int dim>
void expect_patch_test() {
  const Point<dim> gradient = Point<dim>::LinSpaced(3, -2);
  for (const Kind& kind : kinds<dim>()) {
    mesh::BlockMesh<dim> mesh = cube_of<dim>(kind, 0.25);
    shake(mesh, 0.02);
    const HeatModel model = model_of(mesh);
    const auto size = static_cast<Eigen::Index>(mesh.nodes.size());
    Eigen::VectorXd temperature(size), inflow = Eigen::VectorXd::Zero(size);
    for (const NodeId node : mesh.nodes.ids()) temperature[node.value()] = 300 + gradient.dot(mesh.nodes[node]);
    for (const auto& face : mesh::weighted_faces(mesh)) {
      const double flow = conductivity * face.weight * gradient.dot(area_vector<dim>(mesh, face));
      for (const NodeId node : face.nodes) inflow[node.value()] += flow / dim;
    }
    const Eigen::VectorXd balance = model.conductance * temperature - inflow;
    EXPECT_LT(balance.cwiseAbs().maxCoeff(), 1e-12) << name_of(kind);
    EXPECT_GT(inflow.cwiseAbs().maxCoeff(), 0.01) << name_of(kind);
    for (const Point<dim>& flux : cell_fluxes(mesh, unit_material(), temperature)) {
      EXPECT_LT((flux + conductivity * gradient).norm(), 1e-10) << name_of(kind);
    }
  }
}

TEST(ElementKinds, PassThePatchTestOnDistortedMeshesInThePlane) {
  expect_patch_test<2>();
}
TEST(ElementKinds, PassThePatchTestOnDistortedMeshesInSpace) {
  expect_patch_test<3>();
}

template <int dim>
void expect_sound_matrices() {
  for (const Kind& kind : kinds<dim>()) {
    mesh::BlockMesh<dim> mesh = cube_of<dim>(kind, 0.25);
    shake(mesh, 0.02);
    const HeatModel model = model_of(mesh);
    const SparseMatrix transposed = model.conductance.transpose();
    EXPECT_LT((model.conductance - transposed).norm(), 1e-13) << name_of(kind);
    double volume = 0;
    for (const ElementId e : mesh.elements.ids()) volume += mesh::element_volume(mesh, e);
    // Each diagonal of a twisted face holds another volume.
    EXPECT_NEAR(model.capacity.sum(), volume, dim == 2 ? 1e-13 : 2e-3) << name_of(kind);
    EXPECT_GT(model.capacity.minCoeff(), 0) << name_of(kind);
  }
}

TEST(ElementKinds, ConductSymmetricallyAndHoldTheHeatOfTheirVolume) {
  expect_sound_matrices<2>();
  expect_sound_matrices<3>();
}

// -k lap T = f with T = prod cos(pi x), zero on the surface of the cube. The root mean square error over the volume.
template <int dim>
double manufactured_error(const Kind& kind, double mesh_size) {
  mesh::BlockMesh<dim> mesh = cube_of<dim>(kind, mesh_size);
  bend(mesh);
  const HeatModel model = model_of(mesh);
  std::vector<Eigen::Index> place(mesh.nodes.size(), -1);
  Eigen::Index count = 0;
  Eigen::VectorXd exact(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) {
    exact[node.value()] = 1;
    for (int i = 0; i < dim; ++i) exact[node.value()] *= std::cos(M_PI * mesh.nodes[node][i]);
    if (mesh.nodes[node].cwiseAbs().maxCoeff() < 0.5 - 1e-9) place[node.index()] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load(count);
  for (Eigen::Index column = 0; column < model.conductance.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(model.conductance, column); entry; ++entry) {
      const Eigen::Index i = place[entry.row()], j = place[entry.col()];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, entry.value());
    }
    const double source = conductivity * dim * M_PI * M_PI * exact[column];
    if (place[column] >= 0) load[place[column]] = source * model.capacity[column];
  }
  SparseMatrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd found = Eigen::SimplicialLDLT<SparseMatrix>(matrix).solve(load);
  double squares = 0;
  for (std::size_t node = 0; node < place.size(); ++node) {
    if (place[node] < 0) continue;
    const auto at = static_cast<Eigen::Index>(node);
    squares += model.capacity[at] * std::pow(found[place[node]] - exact[at], 2);
  }
  return std::sqrt(squares);
}

template <int dim>
void expect_second_order(double coarse, double fine) {
  for (const Kind& kind : kinds<dim>()) {
    const double first = manufactured_error<dim>(kind, coarse), second = manufactured_error<dim>(kind, fine);
    const double order = std::log(first / second) / std::log(coarse / fine);
    testing::Test::RecordProperty(name_of(kind) + std::to_string(dim), std::to_string(order));
    EXPECT_NEAR(order, 2, 0.25) << name_of(kind) << ": " << first << " at " << coarse << ", " << second << " at " << fine;
  }
}

TEST(ElementKinds, ConvergeWithTheSquareOfTheMeshSizeInThePlane) {
  expect_second_order<2>(1.0 / 10, 1.0 / 40);
}
TEST(ElementKinds, ConvergeWithTheSquareOfTheMeshSizeInSpace) {
  expect_second_order<3>(1.0 / 6, 1.0 / 18);
}

}  // namespace
}  // namespace scree::thermal
