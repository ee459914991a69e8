// Bodies that another scene speaks of by the same names.
#include "engine/mesh/made_from.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/temp_folder.h"

namespace scree::mesh {
namespace {

BodySpec box(const Eigen::Vector3d& size, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  BodySpec body;
  body.name = "block";
  body.shape = Box{size};
  body.arrangement = AtPoses{{Pose{centre}}};
  body.mesh_size = 0.1;
  return body;
}

std::vector<MakingDifference> between(const BodySpec& a, const BodySpec& b, Places places = Places::compared) {
  return differences(made_from(a), made_from(b), places);
}

TEST(MadeFrom, TellsWhichKeyOfABodyIsAnother) {
  const BodySpec body = box({1, 2, 3});
  const auto key_of = [&](auto change) {
    BodySpec other = body;
    change(other);
    const auto found = between(body, other);
    return found.size() == 1 ? found[0].key : "none or several";
  };
  EXPECT_EQ(key_of([](BodySpec& other) { other.shape = Box{{1, 2, 3.5}}; }), "box");
  EXPECT_EQ(key_of([](BodySpec& other) { other.mesh_size = 0.2; }), "mesh_size");
  EXPECT_EQ(key_of([](BodySpec& other) { other.cells = CellKind::hexahedron; }), "elements");
  EXPECT_EQ(key_of([](BodySpec& other) { other.blocks = BlockRule::per_element; }), "blocks");
  EXPECT_EQ(key_of([](BodySpec& other) { other.arrangement = AtPoses{{Pose{{0, 0, 1}}}}; }), "box");
}

TEST(MadeFrom, IsTheSameForNamesMaterialsAndTheLastDigit) {
  BodySpec other = box({0.1 * 3, -0.0, 0});
  other.name = "another";
  other.material = MaterialId{3};
  EXPECT_NE(0.1 * 3, 0.3);
  EXPECT_TRUE(between(box({0.3, 0, 0}), other).empty());
}

TEST(MadeFrom, NamesBothShapesWhereTheyAreOfDifferentKinds) {
  BodySpec ball = box({1, 1, 1});
  ball.shape = Sphere{1};
  const auto found = between(box({1, 1, 1}), ball, Places::left_out);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].key, "sphere");
  EXPECT_EQ(found[0].second, "1 m across");
  EXPECT_EQ(found[0].first, "box: (1, 1, 1) m");
}

TEST(MadeFrom, LeavesOutPlacesButNotTheNumberOfCopies) {
  BodySpec one = box({1, 1, 1}), lattice = box({1, 1, 1});
  one.arrangement = OnLattice{{0, 0, 0}, {2, 2, 1}, {1, 1, 1}, Eigen::Quaterniond::Identity()};
  lattice.arrangement = OnLattice{{0, 0, 5}, {2, 2, 1}, {1, 1, 1}, Eigen::Quaterniond::Identity()};
  EXPECT_TRUE(between(one, lattice, Places::left_out).empty());
  ASSERT_EQ(between(one, lattice).size(), 1u);
  std::get<OnLattice>(lattice.arrangement).count = {2, 3, 1};
  const auto found = between(one, lattice, Places::left_out);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].key, "lattice");
  EXPECT_EQ(found[0].first, "4 copies");
  EXPECT_EQ(found[0].second, "6 copies");
}

TEST(MadeFrom, KnowsAMeshFileByItsContentsWhateverItIsCalled) {
  const test::TempFolder folder;
  const auto of = [&](const char* name, const char* contents) {
    std::ofstream(folder.path() / name) << contents;
    BodySpec body = box({1, 1, 1});
    body.shape = MeshFile{folder.path() / name, 1};
    return body;
  };
  const BodySpec a = of("a.stl", "a mesh"), same = of("b.stl", "a mesh"), other = of("c.stl", "another");
  EXPECT_TRUE(between(a, same).empty());
  EXPECT_EQ(between(a, other).size(), 1u);
}

}  // namespace
}  // namespace scree::mesh
