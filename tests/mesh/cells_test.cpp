#include "engine/mesh/cells.h"

#include <numbers>
#include <numeric>

#include <gmock/gmock.h>

#include "engine/mesh/surfaces.h"
#include "tests/mesh/body_builders.h"
#include "tests/mesh/sample_files.h"

namespace scree::mesh {
namespace {

using testing::HasSubstr;

constexpr std::array kinds{CellKind::quadrilateral, CellKind::wedge, CellKind::hexahedron};

// The corners of the reference cell: of the unit square, or the unit cube and its half.
Eigen::Vector3d corner_of(CellKind kind, std::size_t corner) {
  static constexpr double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  static constexpr double triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  const std::size_t around = kind == CellKind::wedge ? 3 : 4;
  const double* plane = kind == CellKind::wedge ? triangle[corner % around] : square[corner % around];
  return {plane[0], plane[1], corner < around ? 0.0 : 1.0};
}

double volume_of(CellKind kind) {
  return kind == CellKind::wedge ? 0.5 : 1.0;
}

template <int dim, class Corners>
double volume(CellKind kind, const Corners& corners) {
  Eigen::Matrix<double, dim, dim> edges;
  const Eigen::Vector3d first = corner_of(kind, corners[0]);
  for (int i = 0; i < dim; ++i) edges.col(i) = (corner_of(kind, corners[i + 1]) - first).template head<dim>();
  return edges.determinant() / (dim == 2 ? 2 : 6);
}

double volume(CellKind kind, const CornerList& corners) {
  return kind == CellKind::quadrilateral ? volume<2>(kind, corners) : volume<3>(kind, corners);
}

TEST(CellKinds, EachOfTheTwoSplitsFillsTheCell) {
  for (const CellKind kind : kinds) {
    const auto simplices = mixed_simplices(kind);
    const std::size_t half = simplices.size() / 2;
    double sum[2] = {0, 0};
    for (std::size_t s = 0; s < simplices.size(); ++s) {
      EXPECT_GT(volume(kind, simplices[s]), 0.1) << kind_name(kind) << s;
      sum[s / half] += volume(kind, simplices[s]);
    }
    EXPECT_NEAR(sum[0], volume_of(kind), 1e-15) << kind_name(kind);
    EXPECT_NEAR(sum[1], volume_of(kind), 1e-15) << kind_name(kind);
  }
  EXPECT_EQ(mixed_simplices(CellKind::quadrilateral).size(), 4u);
  EXPECT_EQ(mixed_simplices(CellKind::wedge).size(), 6u);
  EXPECT_EQ(mixed_simplices(CellKind::hexahedron).size(), 10u);
}

// Every edge across a quadrilateral face that the simplices of one split have.
std::vector<std::array<std::size_t, 2>> diagonals(CellKind kind, int split) {
  std::vector<std::array<std::size_t, 2>> found;
  const auto simplices = mixed_simplices(kind);
  const auto half = simplices.size() / 2;
  const auto has = [](const CornerList& list, std::size_t corner) {
    return std::find(list.begin(), list.end(), corner) != list.end();
  };
  for (const CornerList& face : cell_faces(kind)) {
    if (face.size() != 4) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const bool there = std::any_of(simplices.begin() + split * static_cast<long>(half),
                                     simplices.begin() + (split + 1) * static_cast<long>(half),
                                     [&](const CornerList& s) { return has(s, face[i]) && has(s, face[i + 2]); });
      if (there) found.push_back({face[i], face[i + 2]});
    }
  }
  return found;
}

TEST(CellKinds, TheTwoSplitsCutEveryQuadrilateralFaceAlongDifferentDiagonals) {
  for (const auto& [kind, faces] : {std::pair(CellKind::wedge, 3u), std::pair(CellKind::hexahedron, 6u)}) {
    const auto first = diagonals(kind, 0), second = diagonals(kind, 1);
    EXPECT_EQ(first.size(), faces);
    EXPECT_EQ(second.size(), faces);
    for (const auto& diagonal : first) EXPECT_THAT(second, testing::Not(testing::Contains(diagonal)));
  }
}

TEST(CellKinds, TheConformingSplitFillsTheCellHoweverItsNodesAreNumbered) {
  for (const CellKind kind : kinds) {
    std::array<std::size_t, 8> nodes{};
    std::iota(nodes.begin(), nodes.end(), std::size_t{0});
    const auto end = nodes.begin() + static_cast<long>(corner_count(kind));
    do {
      double sum = 0;
      const auto add = [&](const auto& simplices) {
        EXPECT_EQ(simplices.size(), split_count(kind));
        for (auto simplex : simplices) {
          // Back from numbers to corners.
          for (auto& n : simplex) n = static_cast<std::size_t>(std::find(nodes.begin(), end, n) - nodes.begin());
          EXPECT_GT(volume(kind, CornerList(simplex)), 0.1);
          sum += volume(kind, CornerList(simplex));
        }
      };
      if (kind == CellKind::quadrilateral) {
        add(split_by_smallest<2>(kind, nodes));
      } else {
        add(split_by_smallest<3>(kind, nodes));
      }
      ASSERT_NEAR(sum, volume_of(kind), 1e-14) << kind_name(kind);
    } while (std::next_permutation(nodes.begin(), end));
  }
}

BodySpec in_cells(Shape shape, double mesh_size, CellKind kind, BlockRule rule = BlockRule::whole) {
  BodySpec body = body_of(std::move(shape), mesh_size, rule);
  body.cells = kind;
  return body;
}

// Inner faces fit: the boundary is the surface of the shape and nothing else.
template <int dim>
double boundary_area(const BlockMesh<dim>& mesh) {
  double area = 0;
  for (const auto& face : boundary_faces(mesh)) area += face_area(mesh, face);
  return area;
}

template <int dim>
double weighted_area(const BlockMesh<dim>& mesh) {
  double area = 0;
  for (const auto& face : weighted_faces(mesh)) area += face.weight * face_area<dim>(mesh, face);
  return area;
}

TEST(Cells, ABoxOfHexahedraHasItsVolumeItsSurfaceAndItsCount) {
  for (const CellKind kind : {CellKind::hexahedron, CellKind::wedge}) {
    const auto mesh = make_blocks<3>({in_cells(box_of(0.4, 0.3, 0.2), 0.1, kind)});
    ASSERT_EQ(mesh.blocks.size(), 1u);
    EXPECT_TRUE(kind == CellKind::wedge || mesh.cells.size() == 4u * 3 * 2);
    EXPECT_EQ(mesh.blocks[BlockId{0}].cells.size(), mesh.cells.size());
    EXPECT_EQ(mesh.elements.size(), mesh.cells.size() * split_count(kind));
    for (const Cell& cell : mesh.cells) EXPECT_EQ(cell.kind, kind);
    EXPECT_NEAR(total_volume(mesh), 0.024, 1e-15);
    EXPECT_NEAR(boundary_area(mesh), 2 * (0.12 + 0.06 + 0.08), 1e-14);
    EXPECT_NEAR(weighted_area(mesh), 2 * (0.12 + 0.06 + 0.08), 1e-14);
  }
}

TEST(Cells, PlaneAndRoundShapesAreMeshedInThemToo) {
  const auto rectangle = make_blocks<2>({in_cells(box_of(2, 1, 0), 0.25, CellKind::quadrilateral)});
  EXPECT_EQ(rectangle.cells.size(), 32u);
  EXPECT_NEAR(total_volume(rectangle), 2, 1e-14);
  const auto disc = make_blocks<2>({in_cells(Sphere{2}, 0.2, CellKind::quadrilateral)});
  EXPECT_EQ(disc.elements.size(), 2 * disc.cells.size());
  EXPECT_NEAR(total_volume(disc), std::numbers::pi, 0.05);
  for (const CellKind kind : {CellKind::hexahedron, CellKind::wedge}) {
    const auto cylinder = make_blocks<3>({in_cells(Cylinder{2, 1}, 0.25, kind)});
    EXPECT_NEAR(total_volume(cylinder), std::numbers::pi, 0.06);
    EXPECT_NEAR(boundary_area(cylinder), weighted_area(cylinder), 1e-12);
  }
}

TEST(Cells, ANamedSurfaceHoldsBothDiagonalsOfItsFaces) {
  const auto mesh = make_blocks<3>({in_cells(box_of(0.4, 0.3, 0.2), 0.1, CellKind::hexahedron)});
  const SurfaceId low = find_surface(mesh, BodyId{0}, "z_low").value();
  double by_boundary = 0, by_weight = 0;
  for (const auto& face : boundary_faces(mesh)) by_boundary += on_surface<3>(mesh, face.nodes, low) ? face_area(mesh, face) : 0;
  for (const auto& face : weighted_faces(mesh)) {
    by_weight += on_surface<3>(mesh, face.nodes, low) ? face.weight * face_area<3>(mesh, face) : 0;
  }
  EXPECT_NEAR(by_boundary, 0.12, 1e-15);
  EXPECT_NEAR(by_weight, 0.12, 1e-15);
  EXPECT_EQ(surface_nodes(mesh, low).size(), 5u * 4);
}

TEST(Cells, EveryCellIsABlockIfTheBodyIsBroken) {
  for (const CellKind kind : {CellKind::hexahedron, CellKind::wedge}) {
    const auto whole = make_blocks<3>({in_cells(box_of(0.4, 0.3, 0.2), 0.1, kind)});
    const auto broken = make_blocks<3>({in_cells(box_of(0.4, 0.3, 0.2), 0.1, kind, BlockRule::per_element)});
    EXPECT_EQ(broken.blocks.size(), whole.cells.size());
    EXPECT_NEAR(total_volume(broken), 0.024, 1e-15);
    for (const Block& block : broken.blocks) {
      EXPECT_EQ(block.cells.size(), 1u);
      EXPECT_EQ(block.nodes.size(), corner_count(kind));
    }
    EXPECT_EQ(broken.surfaces.size(), whole.surfaces.size());
  }
}

TEST(Cells, AKindThatDoesNotFitIsRefused) {
  const auto refusal = [](auto dim, Shape shape, CellKind kind) {
    return input_error([&] { make_blocks<decltype(dim)::value>({in_cells(shape, 0.5, kind)}); });
  };
  constexpr std::integral_constant<int, 2> plane;
  constexpr std::integral_constant<int, 3> space;
  EXPECT_THAT(refusal(plane, box_of(1, 1, 0), CellKind::wedge),
              HasSubstr("bodies.stone.elements is wedge (must be simplex or quadrilateral in 2-D)"));
  EXPECT_THAT(refusal(space, box_of(1, 1, 1), CellKind::quadrilateral),
              HasSubstr("bodies.stone.elements is quadrilateral (must be simplex, wedge or hexahedron in 3-D)"));
  EXPECT_THAT(refusal(space, Sphere{1}, CellKind::hexahedron),
              HasSubstr("bodies.stone.elements is hexahedron (a sphere is made of simplices only)"));
  EXPECT_THAT(refusal(space, MeshFile{"a.msh"}, CellKind::hexahedron),
              HasSubstr("bodies.stone.elements is hexahedron (is for shapes; a mesh file says what its elements are)"));
}

using CellFiles = MeshFileTest;

TEST_F(CellFiles, HexahedraAndWedgesOfEitherOrientationAreUsedAsTheyAre) {
  const FileCell hexahedron{Kind::hexahedron, {1, 2, 4, 3, 5, 6, 8, 7}};
  const FileCell upper{Kind::wedge, {1, 2, 3, 5, 6, 7}}, turned{Kind::wedge, {2, 3, 4, 6, 7, 8}};
  const FileCell face{Kind::quadrangle, {1, 2, 4, 3}};
  for (const std::vector<FileCell>& cells : {std::vector{face, hexahedron}, std::vector{upper, turned}}) {
    const auto mesh = make_blocks<3>({body_with("cells.msh", msh_text(cube_points(), cells))});
    EXPECT_EQ(mesh.blocks.size(), 1u);
    EXPECT_NEAR(total_volume(mesh), 1, 1e-14);
    EXPECT_NEAR(boundary_area(mesh), 6, 1e-14);
  }
}

// A hexahedron with two wedges above it: on their sides of two triangles they do not meet its quadrilateral.
TEST_F(CellFiles, AQuadrilateralBesideTrianglesIsRefused) {
  Points points = cube_points();
  for (const auto& [x, y, z] : {std::array{0.0, 0.0, 2.0}, {1.0, 0.0, 2.0}, {0.0, 1.0, 2.0}, {1.0, 1.0, 2.0}})
    points.push_back({x, y, z});
  const FileCell hexahedron{Kind::hexahedron, {1, 2, 4, 3, 5, 6, 8, 7}};
  const std::vector<FileCell> triangles{{Kind::wedge, {5, 6, 7, 9, 10, 11}}, {Kind::wedge, {6, 8, 7, 10, 12, 11}}};
  EXPECT_THAT(refusal("triangles.msh", msh_text(points, {hexahedron, triangles[0], triangles[1]})),
              HasSubstr("elements 1 and 2 lie on each other near (0, 0, 1) m, but share no face"));
  const std::vector<FileCell> lying{{Kind::wedge, {5, 6, 9, 7, 8, 11}}, {Kind::wedge, {6, 10, 9, 8, 12, 11}}};
  const auto mesh = make_blocks<3>({body_with("lying.msh", msh_text(points, {hexahedron, lying[0], lying[1]}))});
  EXPECT_EQ(mesh.blocks.size(), 1u);
  EXPECT_NEAR(total_volume(mesh), 2, 1e-14);
}

TEST_F(CellFiles, QuadrilateralsAreTheElementsInThePlane) {
  const Points square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto mesh = make_blocks<2>({body_with("q.msh", msh_text(square, {{Kind::quadrangle, {1, 2, 3, 4}}}))});
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(total_volume(mesh), 1);
  EXPECT_THAT(refusal<2>("back.msh", msh_text(square, {{Kind::quadrangle, {1, 4, 3, 2}}})),
              HasSubstr("quadrilateral 1 is inside out, flat or not convex"));
}

TEST_F(CellFiles, WhatDoesNotGoTogetherIsRefused) {
  const FileCell hexahedron{Kind::hexahedron, {1, 2, 4, 3, 5, 6, 8, 7}};
  Points points = cube_points();
  points.push_back({0.5, 0.5, 2});
  const FileCell tetrahedron{Kind::tetrahedron, {5, 6, 7, 9}};
  EXPECT_THAT(refusal("mixed.msh", msh_text(points, {hexahedron, tetrahedron})),
              HasSubstr("it holds hexahedron beside tetrahedra"));
  EXPECT_THAT(refusal("faces.msh", msh_text(points, {{Kind::quadrangle, {1, 2, 4, 3}},
                                                     {Kind::tetrahedron, {1, 2, 3, 5}},
                                                     {Kind::tetrahedron, {4, 6, 7, 8}},
                                                     tetrahedron})),
              HasSubstr("belongs to no wedge or hexahedron"));
  EXPECT_THAT(refusal<2>("solid.msh", msh_text(cube_points(), {hexahedron})), HasSubstr("a scene in 2-D has no hexahedron"));
  const FileCell inside_out{Kind::hexahedron, {5, 6, 8, 7, 1, 2, 4, 3}};
  EXPECT_THAT(refusal("out.msh", msh_text(cube_points(), {inside_out})), HasSubstr("hexahedron 1 is inside out"));
}

}  // namespace
}  // namespace scree::mesh
