#include "contact/one_sided.h"

#include <gtest/gtest.h>

#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

// Sixteen small cubes side by side, from (x, 0, 0) to (x + 0.25, 1, 1).
BlockOf<3> fine_plate(double x) {
  BlockOf<3> plate;
  for (int y = 0; y < 4; ++y) {
    for (int z = 0; z < 4; ++z) {
      const auto small = box<3>(Point<3>(x, 0.25 * y, 0.25 * z), Point<3>(0.25, 0.25, 0.25));
      plate.insert(plate.end(), small.begin(), small.end());
    }
  }
  return plate;
}

// A cube of edge 1 and, a gap away, a plate that covers its face.
mesh::BlockMesh<3> cube_before_fine_plate(double gap) {
  return mesh_of<3>({box<3>(Point<3>(0, 0, 0), Point<3>(1, 1, 1)), fine_plate(1 + gap)});
}

std::size_t owned_by(const ContactSet<3>& set, std::size_t block) {
  std::size_t count = 0;
  for (const auto& contact : set.contacts) count += contact.owner == BlockId{block} ? 1 : 0;
  return count;
}

TEST(OneSided, AreSemiSpringsThatReachAcrossAGapWhichTheFinerSideDoesNot) {
  const auto mesh = cube_before_fine_plate(0.006);
  const ContactOptions options;
  const auto found = find_contacts<3>(mesh, options);
  ASSERT_EQ(owned_by(found, 1), 0u);
  const auto told = one_sided(mesh, found, options.tolerance);
  ASSERT_TRUE(told.has_value());
  EXPECT_EQ(told->contacts, owned_by(found, 0));
  EXPECT_NEAR(told->area, 1, 1e-12);
}

TEST(OneSided, AreNoneWithTheToleranceThatIsTold) {
  const auto mesh = cube_before_fine_plate(0.006);
  ContactOptions options;
  options.tolerance = 1.001 * one_sided(mesh, find_contacts<3>(mesh, options), options.tolerance)->tolerance;
  const auto found = find_contacts<3>(mesh, options);
  EXPECT_EQ(owned_by(found, 1), 96u);  // sixteen squares of two triangles, three semi-springs each
  EXPECT_FALSE(one_sided(mesh, found, options.tolerance).has_value());
}

TEST(OneSided, AreNotToldOfWhereTheyAreALessThanAHundredthOfTheJoints) {
  auto mesh = cube_before_fine_plate(0.006);
  const ContactOptions options;
  const auto found = find_contacts<3>(mesh, options);
  ContactSet<3> more = found;
  for (auto contact : found.contacts) {  // two hundred times the same joint without its gap
    contact.gap = 0;
    contact.area *= 200;
    more.contacts.push_back(contact);
  }
  EXPECT_TRUE(one_sided(mesh, found, options.tolerance).has_value());
  EXPECT_FALSE(one_sided(mesh, more, options.tolerance).has_value());
}

TEST(OneSided, AreNoneWhereFacesTouchOrACornerStandsOnAFace) {
  const ContactOptions options;
  const auto flush = cube_before_fine_plate(0);
  EXPECT_FALSE(one_sided(flush, find_contacts<3>(flush, options), options.tolerance).has_value());
  // A large tetrahedron with a corner on the plate: its semi-springs hang above it, further than the plate's small elements
  // reach, and none of theirs is missing.
  const BlockOf<3> large{{Point<3>(0.999, 0.5, 0.5), Point<3>(0, 0, 0), Point<3>(0, 1, 0.2), Point<3>(0, 0.5, 1)}};
  const auto standing = mesh_of<3>({large, fine_plate(1)});
  const auto found = find_contacts<3>(standing, options);
  ASSERT_GT(owned_by(found, 0), 0u);
  EXPECT_FALSE(one_sided(standing, found, options.tolerance).has_value());
}

}  // namespace
}  // namespace scree::contact
