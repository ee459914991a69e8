#include "engine/mesh/mesh_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/mesh/body_builders.h"
#include "tests/mesh/sample_files.h"

namespace scree::mesh {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using MeshFiles = MeshFileTest;

const Points corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const FileCell one_tetrahedron{Kind::tetrahedron, {1, 2, 3, 4}};

Points both(Points first, const Points& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<FileCell> both(std::vector<FileCell> first, const std::vector<FileCell>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST_F(MeshFiles, AVolumeMeshIsUsedAsItIs) {
  std::vector<BlockMesh<3>> meshes;
  for (const bool binary : {false, true}) {
    write_box(directory_ / "box.msh", binary);
    meshes.push_back(make_blocks<3>({body_with("box.msh", "", 9)}));
    EXPECT_EQ(meshes.back().blocks.size(), 1u);
    EXPECT_NEAR(total_volume(meshes.back()), 6, 1e-12);
  }
  EXPECT_EQ(meshes[0].elements, meshes[1].elements);
  for (const NodeId node : meshes[0].nodes.ids()) {
    EXPECT_LT((meshes[0].nodes[node] - meshes[1].nodes[node]).norm(), 1e-14);
  }
}

// It may be there the next time, with the same file.
TEST_F(MeshFiles, WithoutAFolderForTemporaryFilesItIsTheRunThatFails) {
  write_box(directory_ / "box.msh", false);
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  ASSERT_EQ(setenv("TMPDIR", "/proc/no such folder", 1), 0);
  EXPECT_THROW(make_blocks<3>({body_with("box.msh", "", 9)}), RunError);
  if (before == nullptr) {
    unsetenv("TMPDIR");
  } else {
    setenv("TMPDIR", kept.c_str(), 1);
  }
}

TEST_F(MeshFiles, ASurfaceIsMeshedInsideWithTheMeshSize) {
  for (const bool binary : {false, true}) {
    write_box(directory_ / "box.stl", binary);
    const auto coarse = make_blocks<3>({body_with("box.stl", "", 0.6)});
    const auto fine = make_blocks<3>({body_with("box.stl", "", 0.25)});
    EXPECT_EQ(coarse.blocks.size(), 1u);
    EXPECT_NEAR(total_volume(coarse), 6, 1e-6);
    EXPECT_NEAR(total_volume(fine), 6, 1e-6);
    EXPECT_GT(fine.elements.size(), 2 * coarse.elements.size());
    EXPECT_NEAR(mean_edge(fine), 0.25, 0.1);
  }
}

TEST_F(MeshFiles, ASurfaceInAMeshFileIsMeshedInsideToo) {
  const auto mesh = make_blocks<3>({body_with("cube.msh", msh_text(cube_points(), cube_triangles()), 0.3)});
  EXPECT_NEAR(total_volume(mesh), 1, 1e-13);
  EXPECT_NEAR(mean_edge(mesh), 0.3, 0.1);
  for (const ElementId e : mesh.elements.ids()) EXPECT_GT(element_volume(mesh, e), 0);
}

TEST_F(MeshFiles, WhichWayASurfaceFacesDoesNotMatter) {
  auto triangles = cube_triangles();
  for (FileCell& cell : triangles) std::swap(cell.nodes[1], cell.nodes[2]);
  const auto inside_out = make_blocks<3>({body_with("out.msh", msh_text(cube_points(), triangles))});
  EXPECT_NEAR(total_volume(inside_out), 1, 1e-13);
  std::swap(triangles[3].nodes[1], triangles[3].nodes[2]);
  const auto mixed = make_blocks<3>({body_with("mixed.msh", msh_text(cube_points(), triangles))});
  EXPECT_NEAR(total_volume(mixed), 1, 1e-13);
}

TEST_F(MeshFiles, TheSameFileGivesTheSameMeshToTheBit) {
  const auto body = body_with("cube.msh", msh_text(cube_points(), cube_triangles()), 0.2);
  const auto first = make_blocks<3>({body}), second = make_blocks<3>({body});
  EXPECT_EQ(first.nodes, second.nodes);
  EXPECT_EQ(first.elements, second.elements);
}

TEST_F(MeshFiles, TheScaleIsMetresPerUnit) {
  auto body = body_with("tet.msh", msh_text(corners, {one_tetrahedron}));
  std::get<MeshFile>(body.shape).scale = 0.001;
  EXPECT_NEAR(total_volume(make_blocks<3>({body})), 1e-9 / 6, 1e-24);
}

TEST_F(MeshFiles, TrianglesAreTheElementsInThePlane) {
  const auto body = body_with("plane.msh", msh_text({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                                    {{Kind::triangle, {1, 2, 3}}, {Kind::triangle, {1, 3, 4}}}));
  const auto mesh = make_blocks<2>({body});
  EXPECT_EQ(mesh.elements.size(), 2u);
  EXPECT_EQ(mesh.nodes.size(), 4u);
  EXPECT_EQ(total_volume(mesh), 1);
}

TEST_F(MeshFiles, LoosePartsAreBlocksOfTheirOwn) {
  const Points points = both(corners, {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}});
  const FileCell second{Kind::tetrahedron, {5, 6, 7, 8}};
  EXPECT_EQ(make_blocks<3>({body_with("two.msh", msh_text(points, {one_tetrahedron, second}))}).blocks.size(), 2u);
  const auto shells =
      body_with("shells.msh", msh_text(both(cube_points(), cube_points(3)), both(cube_triangles(), cube_triangles(9))));
  const auto mesh = make_blocks<3>({shells});
  EXPECT_EQ(mesh.blocks.size(), 2u);
  EXPECT_NEAR(total_volume(mesh), 2, 1e-13);
}

TEST_F(MeshFiles, FacesBesideTetrahedraAreTheirBoundary) {
  const FileCell face{Kind::triangle, {1, 3, 2}}, line{Kind::line, {1, 2}};
  const auto mesh = make_blocks<3>({body_with("tet.msh", msh_text(corners, {line, face, one_tetrahedron}))});
  EXPECT_EQ(mesh.elements.size(), 1u);
}

TEST_F(MeshFiles, AMissingFileIsSaid) {
  EXPECT_EQ(refusal("none.msh", ""), "(no such file). A relative path counts from the scene's folder");
}

TEST_F(MeshFiles, AnUnknownKindOfFileIsSaid) {
  EXPECT_EQ(refusal("stone.obj", "v 0 0 0"), "(must be one of .msh, .stl). Convert the mesh, for instance with Gmsh");
}

TEST_F(MeshFiles, AScriptInPlaceOfAMeshIsNotRun) {
  EXPECT_EQ(refusal("script.msh", "SystemCall \"touch ran\";"),
            "(must be a whole .msh mesh; it cannot be read: it does not begin with $MeshFormat). Export it again");
}

// Gmsh takes STL for a script where its name ends in neither small nor large letters, and reads FILE.opt as one.
TEST_F(MeshFiles, NorAScriptBesideAMeshOrUnderAnotherSpellingOfItsName) {
  const auto run = directory_ / "ran";
  const std::string script = "SystemCall \"touch " + run.string() + "\";";
  EXPECT_THAT(refusal("script.Stl", script), StartsWith("(it holds no elements"));
  std::ofstream(directory_ / "tet.msh.opt") << script;
  const FileCell line{Kind::line, {1, 2}};
  EXPECT_EQ(make_blocks<3>({body_with("tet.msh", msh_text(corners, {line, one_tetrahedron}))}).elements.size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(run));
}

TEST_F(MeshFiles, ADamagedFileIsRefusedWhereverItEnds) {
  write_box(directory_ / "box.msh", true);
  std::ostringstream whole;
  whole << std::ifstream(directory_ / "box.msh", std::ios::binary).rdbuf();
  for (const double part : {0.01, 0.2, 0.5, 0.9}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(whole.str().size()));
    EXPECT_THAT(refusal("cut.msh", whole.str().substr(0, length)), StartsWith("(must be a whole .msh mesh; it cannot be read"));
  }
  EXPECT_THAT(refusal("cut.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
              StartsWith("(must be a whole .stl mesh; it cannot be read"));
  EXPECT_THAT(refusal("nan.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 -NaN 0\nvertex 1 0 0\nvertex 0 1 0\n"),
              StartsWith("(must be a whole .stl mesh; it cannot be read: a coordinate in its line 4 is no number)"));
  EXPECT_THAT(refusal("NAN.stl", "SOLID s\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVertex 1 NAN 0\nVERTEX 0 1 0\n"),
              StartsWith("(must be a whole .stl mesh; it cannot be read: a coordinate in its line 5 is no number)"));
}

TEST_F(MeshFiles, ACornerOfABinaryFileThatIsNoNumberIsRefusedAtItsTriangle) {
  const std::array<std::array<float, 3>, 4> points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const auto file_with = [&](float of_normal, float of_corner) {
    std::string bytes(80, ' ');
    const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(std::uint32_t{4});
    for (const auto& face : faces) {
      put(std::array<float, 3>{of_normal, 0, 0});
      for (const int corner : face) {
        auto point = points[corner];
        if (corner == 3) point[1] += of_corner;
        put(point);
      }
      put(std::uint16_t{0});
    }
    return bytes;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal("nan.stl", file_with(0, nan)),
              StartsWith("(must be a whole .stl mesh; it cannot be read: a corner of its triangle 2 is no number)"));
  EXPECT_NEAR(total_volume(make_blocks<3>({body_with("tet.stl", file_with(nan, 0))})), 1.0 / 6, 1e-6) << "normals are not read";
}

TEST_F(MeshFiles, AnEmptyMeshIsRefused) {
  EXPECT_EQ(refusal("points.msh", msh_text(corners, {{Kind::line, {1, 2}}, {Kind::line, {3, 4}}})),
            "(it holds no elements with an area or a volume). Export the mesh with its elements");
  EXPECT_EQ(refusal("empty.stl", "solid s\nendsolid s\n"),
            "(it holds no elements with an area or a volume). Export the mesh with its elements");
}

TEST_F(MeshFiles, ElementsThatScreeDoesNotHaveAreNamed) {
  const FileCell pyramid{Kind::pyramid, {1, 2, 4, 3, 5}};
  EXPECT_EQ(
      refusal("pyramid.msh", msh_text(cube_points(), {pyramid})),
      "(must hold elements of first order and no pyramids; it holds 1 x Pyramid 5). Mesh the shape with tetrahedra, wedges "
      "or hexahedra of first order");
}

TEST_F(MeshFiles, AnOpenSurfaceTellsItsOpenEdges) {
  auto triangles = cube_triangles();
  triangles.pop_back();
  EXPECT_EQ(refusal("open.msh", msh_text(cube_points(), triangles)),
            "(must be closed; 3 of its edges have a triangle on one side only, the first from (1, 0, 0) m to (1, 0, 1) m). "
            "Repair the surface, for instance with Meshlab");
}

TEST_F(MeshFiles, ASurfaceWithAFinIsRefused) {
  const Points points = both(cube_points(), {{-1, -1, 0}, {-1, -1, 1}});
  const std::vector<FileCell> fin{
      {Kind::triangle, {1, 5, 9}}, {Kind::triangle, {5, 10, 9}}, {Kind::triangle, {1, 9, 10}}, {Kind::triangle, {1, 10, 5}}};
  EXPECT_EQ(refusal("fin.msh", msh_text(points, both(cube_triangles(), fin))),
            "(must be closed; 1 of its edges have more than two triangles, the first from (0, 0, 0) m to (0, 0, 1) m). "
            "Repair the surface, for instance with Meshlab");
}

TEST_F(MeshFiles, ASurfaceOfCollapsedTrianglesAloneIsRefused) {
  const std::vector<FileCell> collapsed{{Kind::triangle, {1, 2, 2}}, {Kind::triangle, {2, 1, 1}}};
  EXPECT_EQ(refusal("collapsed.msh", msh_text({{0, 0, 0}, {1, 0, 0}}, collapsed)),
            "(all of its triangles are flat). Repair the surface, for instance with Meshlab");
}

TEST_F(MeshFiles, AHollowSurfaceIsRefused) {
  Points inner = cube_points();
  for (auto& point : inner) {
    for (double& x : point) x = 0.3 + 0.4 * x;
  }
  EXPECT_EQ(refusal("hollow.msh", msh_text(both(cube_points(), inner), both(cube_triangles(), cube_triangles(9)))),
            "(shell 2 lies inside shell 1). Give a hollow body as a volume mesh (.msh or .vtu with tetrahedra)");
}

TEST_F(MeshFiles, ASurfaceThatCutsItselfIsRefused) {
  Points points = cube_points();
  points[7] = {0.5, 0.5, -1};  // one corner pulled through the opposite face
  EXPECT_THAT(refusal("cut.msh", msh_text(points, cube_triangles())), StartsWith("(Gmsh could not mesh its inside"));
}

// The unit cube with a node on the edge between its first two, which the triangle on one side or those on both sides do not
// know of: they end at triangles without area.
std::string cube_with_seams(std::size_t seams, double beside = 0) {
  Points points = cube_points();
  std::vector<FileCell> triangles;
  std::size_t seen = 0;
  for (const FileCell& cell : cube_triangles()) {
    auto nodes = cell.nodes;
    const auto first = std::find(nodes.begin(), nodes.end(), 1), second = std::find(nodes.begin(), nodes.end(), 2);
    if (first == nodes.end() || second == nodes.end() || ++seen > seams) {
      triangles.push_back(cell);
      continue;
    }
    points.push_back({0.3 * static_cast<double>(seen), beside, beside});
    const int middle = static_cast<int>(points.size());
    triangles.push_back({Kind::triangle, {1, middle, 2}});
    for (const auto end : {first, second}) {
      auto half = nodes;
      half[static_cast<std::size_t>(end - nodes.begin())] = middle;
      triangles.push_back({Kind::triangle, half});
    }
  }
  return msh_text(points, triangles);
}

TEST_F(MeshFiles, ATriangleAlongAnEdgeLeavesTheShapeAsItIs) {
  for (const double beside : {0.0, 1e-8, -1e-8, 3e-7, -3e-7}) {  // single precision
    const auto mesh = make_blocks<3>({body_with("seam.msh", cube_with_seams(1, beside), 0.3)});
    EXPECT_NEAR(total_volume(mesh), 1, 1e-13 + std::abs(beside));
    EXPECT_NEAR(mean_edge(mesh), 0.3, 0.1);
  }
}

TEST_F(MeshFiles, TrianglesAlongOneEdgeOnBothSidesAreRefused) {
  EXPECT_EQ(refusal("seams.msh", cube_with_seams(2)),
            "(a triangle is flat, near (0, 0, 0) m). Repair the surface, for instance with Meshlab");
}

TEST_F(MeshFiles, ATriangleWithTwoCornersAtOnePlaceIsLeftOut) {
  const Points points = cube_points();
  std::string text = "solid cube\n";
  const auto add = [&](const std::array<int, 3>& nodes) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int node : nodes) {
      const auto& p = points[static_cast<std::size_t>(node - 1)];
      text += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
    }
    text += "endloop\nendfacet\n";
  };
  for (const FileCell& cell : cube_triangles()) add({cell.nodes[0], cell.nodes[1], cell.nodes[2]});
  add({1, 2, 2});
  const auto mesh = make_blocks<3>({body_with("collapsed.stl", text + "endsolid cube\n", 0.3)});
  EXPECT_NEAR(total_volume(mesh), 1, 1e-12);
}

TEST_F(MeshFiles, AnInvertedElementIsNamed) {
  const FileCell inverted{Kind::tetrahedron, {1, 2, 3, 5}};
  EXPECT_EQ(refusal("inverted.msh", msh_text(both(corners, {{0, 0, -1}}), {one_tetrahedron, inverted})),
            "(tetrahedron 2 is inside out). Mesh the shape again");
  EXPECT_EQ(refusal<2>("clockwise.msh", msh_text({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{Kind::triangle, {1, 3, 2}}})),
            "(triangle 1 is inside out). Turn the surface over, so that its triangles run counter-clockwise");
}

TEST_F(MeshFiles, AFlatElementIsNamed) {
  const FileCell flat{Kind::tetrahedron, {1, 2, 3, 5}};
  EXPECT_EQ(refusal("flat.msh", msh_text(both(corners, {{1, 1, 0}}), {one_tetrahedron, flat})),
            "(tetrahedron 2 is flat). Mesh the shape again");
}

TEST_F(MeshFiles, OverlappingElementsAreNamed) {
  EXPECT_EQ(refusal("twice.msh", msh_text(corners, {one_tetrahedron, one_tetrahedron})),
            "(tetrahedrons 1 and 2 lie on the same side of a face). Remove elements that are there twice or overlap");
}

// A square with a corner above it and one below, each side cut into two tetrahedra.
TEST_F(MeshFiles, ElementsThatDoNotFitTogetherAreNamed) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  const std::vector<FileCell> above{{Kind::tetrahedron, {1, 2, 3, 5}}, {Kind::tetrahedron, {1, 3, 4, 5}}};
  const std::vector<FileCell> alike{{Kind::tetrahedron, {1, 3, 2, 6}}, {Kind::tetrahedron, {1, 4, 3, 6}}};
  const std::vector<FileCell> across{{Kind::tetrahedron, {1, 4, 2, 6}}, {Kind::tetrahedron, {2, 4, 3, 6}}};
  EXPECT_EQ(make_blocks<3>({body_with("alike.msh", msh_text(points, both(above, alike)))}).blocks.size(), 1u);
  const std::string text = msh_text(points, both(above, across));
  EXPECT_EQ(refusal("across.msh", text),
            "(elements 1 and 3 lie on each other near (0, 0, 0) m, but share no face). Mesh both sides of that face alike, or "
            "make two bodies of them, with a joint between them");
  BodySpec broken = body_with("broken.msh", text);
  broken.blocks = BlockRule::per_element;
  EXPECT_EQ(make_blocks<3>({broken}).blocks.size(), 4u);
  BodySpec whole = broken;
  whole.blocks = BlockRule::whole;
  EXPECT_THROW(make_blocks<3>({broken, whole}), InputError);
}

TEST_F(MeshFiles, ALongEdgeBesideShortOnesIsNamed) {
  const Points points{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, -1, 0}, {2, -1, 0}};
  const FileCell above{Kind::triangle, {1, 2, 3}}, left{Kind::triangle, {1, 5, 4}}, right{Kind::triangle, {4, 6, 2}};
  EXPECT_THAT(refusal<2>("hanging.msh", msh_text(points, {above, left, {Kind::triangle, {5, 6, 4}}, right})),
              StartsWith("(elements 1 and 2 lie on each other near (0, 0, 0) m"));
  const FileCell half{Kind::triangle, {1, 4, 3}}, other{Kind::triangle, {4, 2, 3}};
  EXPECT_EQ(make_blocks<2>({body_with("whole.msh", msh_text(points, {half, other, left, right}))}).blocks.size(), 1u);
}

TEST_F(MeshFiles, TwoNodesAtOnePlaceAreNamed) {
  const FileCell second{Kind::tetrahedron, {5, 6, 7, 8}};
  EXPECT_EQ(
      refusal("double.msh", msh_text(both(corners, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 2}}), {one_tetrahedron, second})),
      "(nodes 1 and 5 are at the same place). Merge such nodes (in Gmsh: Mesh, Remove duplicate nodes), or make touching "
      "parts bodies of their own");
}

TEST_F(MeshFiles, ALooseNodeIsNamed) {
  EXPECT_EQ(refusal("loose.msh", msh_text(both(corners, {{4, 4, 4}}), {one_tetrahedron})),
            "(1 of its nodes belong to no element; the first is node 5). Remove them, or export the elements they belong to");
}

TEST_F(MeshFiles, ATriangleApartFromTheTetrahedraIsNamed) {
  const Points points = both(corners, {{4, 0, 0}, {5, 0, 0}, {4, 1, 0}});
  EXPECT_EQ(refusal("apart.msh", msh_text(points, {{Kind::triangle, {5, 6, 7}}, one_tetrahedron})),
            "(triangle 1 belongs to no tetrahedron). Mesh the volume behind it, or give it as a body of its own");
}

TEST_F(MeshFiles, ASolidInATwoDimensionalSceneIsRefused) {
  EXPECT_EQ(refusal<2>("solid.msh", msh_text(corners, {one_tetrahedron})),
            "(a scene in 2-D takes triangles or quadrilaterals in the plane z = 0). Use a plane mesh, or `dimension: 3`");
}

TEST_F(MeshFiles, AReaderAddsAKindOfFile) {
  const MeshReader reader = [](const std::filesystem::path&) {
    RawMesh raw;
    for (const auto& [x, y, z] : corners) raw.points.emplace_back(x, y, z);
    raw.point_numbers = {0, 1, 2, 3};
    raw.tetrahedra = {{0, {0, 1, 2, 3}}};
    return raw;
  };
  EXPECT_EQ(make_blocks<3>({body_with("tet.MINE", "any")}, {{".mine", reader}}).elements.size(), 1u);
}

}  // namespace
}  // namespace scree::mesh
