#include "engine/mesh/surfaces.h"

#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/mesh/body_builders.h"
#include "tests/mesh/sample_files.h"

namespace scree::mesh {
namespace {

using testing::ElementsAre;

template <int dim>
double face_area(const BlockMesh<dim>& mesh, const std::array<NodeId, dim>& nodes) {
  const Point<dim> u = mesh.nodes[nodes[1]] - mesh.nodes[nodes[0]];
  if constexpr (dim == 3) return u.cross(mesh.nodes[nodes[2]] - mesh.nodes[nodes[0]]).norm() / 2;
  return u.norm();
}

template <int dim>
double area_of(const BlockMesh<dim>& mesh, BodyId body, const std::string& name) {
  const SurfaceId surface = find_surface(mesh, body, name).value();
  double area = 0;
  for (const auto& face : mesh.surfaces) area += face.surface == surface ? face_area<dim>(mesh, face.nodes) : 0;
  return area;
}

// Every boundary face of a mesh of whole bodies lies on one surface.
template <int dim>
void expect_each_named(const BlockMesh<dim>& mesh) {
  for (const auto& face : boundary_faces(mesh)) {
    int surfaces = 0;
    for (const SurfaceId surface : mesh.surface_names.ids()) surfaces += on_surface<dim>(mesh, face.nodes, surface) ? 1 : 0;
    EXPECT_EQ(surfaces, 1);
  }
}

// And the surfaces have no others; of cells they have both diagonals.
template <int dim>
void expect_all_named(const BlockMesh<dim>& mesh) {
  EXPECT_EQ(mesh.surfaces.size(), boundary_faces(mesh).size());
  expect_each_named(mesh);
}

TEST(Surfaces, TheSidesOfABoxHaveTheirNamesPlacesAndAreas) {
  const auto mesh = make_blocks<3>({body_of(box_of(0.4, 0.3, 0.2), 0.08)});
  EXPECT_THAT(surface_names(mesh, BodyId{0}), ElementsAre("x_low", "x_high", "y_low", "y_high", "z_low", "z_high"));
  expect_all_named(mesh);
  const double areas[3] = {0.3 * 0.2, 0.4 * 0.2, 0.4 * 0.3}, halves[3] = {0.2, 0.15, 0.1};
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      const std::string name = std::string(1, "xyz"[axis]) + (high ? "_high" : "_low");
      EXPECT_NEAR(area_of(mesh, BodyId{0}, name), areas[axis], 1e-14) << name;
      for (const NodeId node : surface_nodes(mesh, *find_surface(mesh, BodyId{0}, name))) {
        EXPECT_EQ(mesh.nodes[node][axis], high ? halves[axis] : -halves[axis]) << name;
      }
    }
  }
}

TEST(Surfaces, ARectangleHasFourAndADiscOne) {
  const auto mesh = make_blocks<2>({body_of(box_of(2, 1, 0), 0.2), body_of(Sphere{2}, 0.1)});
  EXPECT_THAT(surface_names(mesh, BodyId{0}), ElementsAre("x_low", "x_high", "y_low", "y_high"));
  EXPECT_THAT(surface_names(mesh, BodyId{1}), ElementsAre("surface"));
  expect_all_named(mesh);
  EXPECT_NEAR(area_of(mesh, BodyId{0}, "y_high"), 2, 1e-13);
  EXPECT_NEAR(area_of(mesh, BodyId{1}, "surface"), 2 * std::numbers::pi, 0.01);
}

TEST(Surfaces, ACylinderHasASideABottomAndATop) {
  const auto mesh = make_blocks<3>({body_of(Cylinder{0.4, 0.2}, 0.05), body_of(Sphere{0.4}, 0.3)});
  expect_all_named(mesh);
  EXPECT_NEAR(area_of(mesh, BodyId{0}, "side"), std::numbers::pi * 0.4 * 0.2, 0.01 * 0.25);
  const double disc = area_of(mesh, BodyId{0}, "bottom");
  EXPECT_NEAR(disc, std::numbers::pi * 0.04, 0.02 * 0.12);
  EXPECT_NEAR(area_of(mesh, BodyId{0}, "top"), disc, 0.01 * disc);
}

// Ends of lengths that binary fractions do not hold: a face whose nodes miss its plane by a rounding has no name.
TEST(Surfaces, AllOuterFacesHaveNamesWhateverTheSizesAndElements) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> length(0.1, 0.5);
  for (int i = 0; i < 40; ++i) {
    const double a = length(generator), b = length(generator), c = length(generator), size = length(generator) / 2;
    auto bodies = std::vector{body_of(box_of(a, b, c), size), body_of(box_of(a, b, c), size), body_of(Cylinder{a, b}, size),
                              body_of(box_of(c, a, b), size), body_of(Cylinder{b, c}, size)};
    bodies[0].cells = CellKind::hexahedron;
    bodies[1].cells = bodies[2].cells = CellKind::wedge;
    expect_each_named(make_blocks<3>(bodies));
    auto plates = std::vector{body_of(box_of(a, b, 0), size), body_of(box_of(b, c, 0), size)};
    plates[0].cells = CellKind::quadrilateral;
    expect_each_named(make_blocks<2>(plates));
  }
}

TEST(Surfaces, ATurnedCopyKeepsTheNamesOfItsShape) {
  BodySpec body = body_of(box_of(0.4, 0.4, 0.4), 0.2);
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  body.arrangement = AtPoses{{Pose{}, Pose{{5, 0, 0}, quarter}}};
  const auto mesh = make_blocks<3>({body});
  expect_all_named(mesh);
  EXPECT_NEAR(area_of(mesh, BodyId{0}, "x_high"), 2 * 0.16, 1e-14);
  const auto nodes = surface_nodes(mesh, *find_surface(mesh, BodyId{0}, "x_high"));
  for (const NodeId node : nodes) {
    const bool turned = mesh.nodes[node].x() > 2;
    EXPECT_NEAR(mesh.nodes[node][turned ? 1 : 0], 0.2, 1e-15);  // x_high of the turned one looks along y
  }
}

TEST(Surfaces, ABrokenBodyKeepsTheNamesOfItsOuterFacesOnly) {
  const auto whole = make_blocks<3>({body_of(box_of(0.4, 0.3, 0.2), 0.1)});
  const auto broken = make_blocks<3>({body_of(box_of(0.4, 0.3, 0.2), 0.1, BlockRule::per_element)});
  EXPECT_EQ(broken.surfaces.size(), whole.surfaces.size());
  EXPECT_TRUE(std::is_sorted(broken.surfaces.begin(), broken.surfaces.end()));
  for (const std::string& name : surface_names(whole, BodyId{0})) {
    EXPECT_NEAR(area_of(broken, BodyId{0}, name), area_of(whole, BodyId{0}, name), 1e-14);
  }
  for (const NodeId node : surface_nodes(broken, *find_surface(broken, BodyId{0}, "z_low"))) {
    EXPECT_EQ(broken.nodes[node].z(), -0.1);
  }
}

using SurfacesOfFiles = MeshFileTest;

TEST_F(SurfacesOfFiles, PhysicalGroupsAreTheSurfacesOfAMeshFile) {
  write_box_with_groups(directory_ / "box.msh", 3);
  const auto box = make_blocks<3>({body_with("box.msh", "")});
  EXPECT_THAT(surface_names(box, BodyId{0}), ElementsAre("ground", "7"));
  EXPECT_NEAR(area_of(box, BodyId{0}, "ground"), 2, 1e-13);
  for (const NodeId node : surface_nodes(box, *find_surface(box, BodyId{0}, "7"))) EXPECT_EQ(box.nodes[node].z(), 3);
  write_box_with_groups(directory_ / "plate.msh", 2);
  const auto plate = make_blocks<2>({body_with("plate.msh", "")});
  EXPECT_THAT(surface_names(plate, BodyId{0}), ElementsAre("ground", "7"));
  EXPECT_NEAR(area_of(plate, BodyId{0}, "7"), 1, 1e-13);
}

TEST_F(SurfacesOfFiles, APhysicalGroupWithTheNameOfAnEarlierOneGoesByItsNumber) {
  const auto file = directory_ / "box.msh";
  write_box_with_groups(file, 3);
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string twice = text.str();
  const std::string once = "1\n2 3 \"ground\"\n";
  ASSERT_NE(twice.find(once), std::string::npos);
  twice.replace(twice.find(once), once.size(), "2\n2 3 \"ground\"\n2 7 \"ground\"\n");
  const auto box = make_blocks<3>({body_with("twice.msh", twice)});
  EXPECT_THAT(surface_names(box, BodyId{0}), ElementsAre("ground", "7"));
  EXPECT_NEAR(area_of(box, BodyId{0}, "7"), 2, 1e-13);
}

// Tetrahedra apart, numbered corner by corner through all of them, whose lowest faces are one surface. A surface may name what
// is no face of the mesh, and a face between two parts is none.
RawMesh loose_tetrahedra(std::size_t count) {
  const std::array<Eigen::Vector3d, 4> corners{Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  RawMesh raw;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    for (std::size_t i = 0; i < count; ++i) {
      raw.point_numbers.push_back(raw.points.size());
      raw.points.emplace_back(corners[corner] + Eigen::Vector3d(2 * static_cast<double>(i), 0, 0));
    }
  }
  raw.surfaces.push_back({"ground", 2, {{0, count, 2 * count + 1}}});
  for (std::size_t i = count; i-- > 0;) {
    raw.tetrahedra.push_back({i, {i, count + i, 2 * count + i, 3 * count + i}});
    raw.surfaces[0].faces.push_back({count + i, i, 2 * count + i});
  }
  return raw;
}

TEST_F(SurfacesOfFiles, ASurfaceReachesAcrossLooseParts) {
  const std::size_t count = 300;
  const MeshReaders readers{{".vtu", [](const auto&) { return loose_tetrahedra(count); }}};
  const auto mesh = make_blocks<3>({body_with("parts.vtu", "read by the reader")}, readers);
  ASSERT_EQ(mesh.blocks.size(), count);
  EXPECT_EQ(mesh.surfaces.size(), count);
  EXPECT_NEAR(area_of(mesh, BodyId{0}, "ground"), 0.5 * count, 1e-11);
  // Blocks in the order of the elements, their nodes in that of the file.
  for (const BlockId block : mesh.blocks.ids()) {
    const Point<3>& first = mesh.nodes[*mesh.blocks[block].nodes.begin()];
    EXPECT_EQ(first.x(), 2.0 * static_cast<double>(count - 1 - block.value()));
  }
}

TEST(Surfaces, OneThatIsNotThereIsNotFound) {
  const auto mesh = make_blocks<3>({body_of(Sphere{1}, 1), body_of(box_of(1, 1, 1), 1)});
  EXPECT_FALSE(find_surface(mesh, BodyId{0}, "x_low"));
  EXPECT_FALSE(find_surface(mesh, BodyId{1}, "surface"));
  EXPECT_TRUE(find_surface(mesh, BodyId{1}, "x_low"));
}

}  // namespace
}  // namespace scree::mesh
