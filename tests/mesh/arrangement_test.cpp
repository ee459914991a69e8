#include "engine/mesh/arrangement.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "engine/mesh/random_numbers.h"
#include "tests/mesh/body_builders.h"

namespace scree::mesh {
namespace {

BodySpec arranged(Arrangement arrangement) {
  BodySpec body = body_of(Sphere{1}, 9);
  body.arrangement = std::move(arrangement);
  return body;
}

TEST(Arrangement, ALatticeRunsAlongXFirstAndIsCentred) {
  OnLattice lattice{.centre = {10, 20, 30}, .count = {2, 3, 2}, .spacing = {1, 2, 4}};
  const auto poses = poses_of(arranged(lattice), {}, 3);
  ASSERT_EQ(poses.size(), 12u);
  EXPECT_EQ(poses[0].translation, Eigen::Vector3d(9.5, 18, 28));
  EXPECT_EQ(poses[1].translation, Eigen::Vector3d(10.5, 18, 28));
  EXPECT_EQ(poses[2].translation, Eigen::Vector3d(9.5, 20, 28));
  EXPECT_EQ(poses[11].translation, Eigen::Vector3d(10.5, 22, 32));
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Pose& pose : poses) mean += pose.translation / 12;
  EXPECT_LT((mean - lattice.centre).norm(), 1e-13);
  EXPECT_EQ(poses_of(arranged(lattice), {}, 2).size(), 6u);
}

TEST(Arrangement, RandomCopiesLieInTheirRegionAndDoNotTouch) {
  const AtRandom random{.count = 200, .low = {0, 0, 0}, .high = {2, 3, 4}, .seed = 7};
  const Bounds bounds{{0.1, 0.2, -0.1}, 0.15};
  const auto poses = poses_of(arranged(random), bounds, 3);
  std::vector<Eigen::Vector3d> centres;
  for (const Pose& pose : poses) centres.push_back(pose * bounds.centre);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    EXPECT_GE((centres[i] - random.low).minCoeff(), bounds.radius - 1e-12);
    EXPECT_GE((random.high - centres[i]).minCoeff(), bounds.radius - 1e-12);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((centres[i] - centres[j]).norm(), 2 * bounds.radius - 1e-12);
  }
}

TEST(Arrangement, TheSameSeedGivesTheSamePlacesAndAnotherSeedOthers) {
  const auto drawn = [](std::uint64_t seed) {
    return poses_of(arranged(AtRandom{.count = 20, .high = {9, 9, 9}, .seed = seed}), {{0, 0, 0}, 0.5}, 3);
  };
  const auto first = drawn(1), again = drawn(1), other = drawn(2);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].translation, again[i].translation);
    EXPECT_EQ(first[i].rotation.coeffs(), again[i].rotation.coeffs());
    EXPECT_NE(first[i].translation, other[i].translation);
  }
}

TEST(Arrangement, InThePlaneCopiesStayInIt) {
  for (const Pose& pose : poses_of(arranged(AtRandom{.count = 30, .high = {9, 9, 0}}), {{0.1, 0, 0}, 0.4}, 2)) {
    EXPECT_EQ(pose.translation.z(), 0);
    EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  }
}

TEST(Arrangement, CopiesThatDoNotFitAreAnErrorThatTellsHowManyDid) {
  EXPECT_THAT(input_error([] {
                poses_of(arranged(AtRandom{.count = 50, .high = {2, 2, 2}}), {{0, 0, 0}, 0.5}, 3);
              }),
              testing::MatchesRegex(
                  "scene.yaml:4:10: bodies.stone.random.count is 50 \\([1-8] fitted into the region without touching, "
                  "each in a sphere of radius 0.5 m\\). Ask for fewer, enlarge low and high, or use a lattice"));
  EXPECT_THAT(input_error([] {
                poses_of(arranged(AtRandom{.count = 1, .high = {2, 2, 0.5}}), {{0, 0, 0}, 0.5}, 3);
              }),
              testing::HasSubstr("is 1 (0 fitted"));
}

TEST(Arrangement, MeshedCopiesAtRandomDoNotOverlap) {
  auto body = body_of(box_of(0.4, 0.3, 0.2), 9);
  body.arrangement = AtRandom{.count = 40, .high = {3, 3, 3}, .seed = 3};
  const auto mesh = make_blocks<3>({body});
  ASSERT_EQ(mesh.blocks.size(), 40u);
  for (const Point<3>& node : mesh.nodes) EXPECT_TRUE((Aabb<3>{Point<3>(0, 0, 0), Point<3>(3, 3, 3)}.contains(node)));
}

// Uniform rotations: the image of a fixed vector has mean zero and covariance 1/3 of the unit matrix.
TEST(RandomNumbers, RotationsPreferNoDirection) {
  RandomNumbers random(11);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i) {
    const Eigen::Quaterniond rotation = random.rotation();
    ASSERT_NEAR(rotation.norm(), 1, 1e-14);
    const Eigen::Vector3d image = rotation * Eigen::Vector3d::UnitX();
    mean += image / count;
    covariance += image * image.transpose() / count;
  }
  EXPECT_LT(mean.norm(), 0.02);
  EXPECT_LT((covariance - Eigen::Matrix3d::Identity() / 3).norm(), 0.02);
}

// The 10000th number of std::mt19937_64 with its default seed is given in the standard, [rand.predef].
TEST(RandomNumbers, TheSequenceIsTheStandards) {
  RandomNumbers random(std::mt19937_64::default_seed);
  for (int i = 1; i < 10000; ++i) random.unit();
  EXPECT_EQ(random.unit(), static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
}

}  // namespace
}  // namespace scree::mesh
