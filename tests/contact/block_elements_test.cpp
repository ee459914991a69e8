// Points in blocks of many elements, against all of their elements.
#include "contact/block_elements.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

// An L of small cubes, turned, beside a single tetrahedron.
TEST(BlockElements, HoldThePointsThatOneOfThemDoes) {
  BlockOf<3> elements;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < (i < 2 ? 5 : 2); ++j) {
      for (const auto& simplex : box<3>(at(i, j, 0), at(1, 1, 1))) elements.push_back(simplex);
    }
  }
  const Eigen::AngleAxisd turn(0.7, at(1, 2, 3).normalized());
  for (auto& simplex : elements) {
    for (auto& corner : simplex) corner = turn * corner;
  }
  const auto mesh = mesh_of<3>({elements, {{at(9, 9, 9), at(10, 9, 9), at(9, 10, 9), at(9, 9, 10)}}});
  const BlockElements<3> blocks(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 6);
  int held = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point<3> place(any(random), any(random), 0.5 + 0.2 * any(random));
    // Both legs; a plane between two cubes is met by none of these.
    const bool inside = place.z() > 0 && place.z() < 1 && place.x() > 0 && place.y() > 0 && place.x() < 4 && place.y() < 5 &&
                        (place.x() < 2 || place.y() < 2);
    EXPECT_EQ(blocks.hold(BlockId{0}, ElementId{7}, turn * place), inside) << place.transpose();
    held += inside ? 1 : 0;
  }
  EXPECT_GT(held, 200);
  EXPECT_TRUE(blocks.hold(BlockId{1}, ElementId{elements.size()}, at(9.1, 9.1, 9.1)));
  EXPECT_FALSE(blocks.hold(BlockId{1}, ElementId{elements.size()}, at(9.9, 9.9, 9.1)));
}

}  // namespace
}  // namespace scree::contact
