#include "contact/semi_edge.h"

#include <gtest/gtest.h>

#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

TEST(SemiSpring, ATriangleHasSixAndNoSemiEdges) {
  const auto set = find_contacts<2>(mesh_of<2>({{{Point<2>{0, 0}, Point<2>{1, 0}, Point<2>{0, 1}}}}), {});
  EXPECT_EQ(set.semi_springs, 6);
  EXPECT_EQ(set.semi_edges, 0);
  EXPECT_TRUE(set.contacts.empty());
}

TEST(SemiSpring, ATetrahedronHasTwelveAndTwelveSemiEdges) {
  const auto set = find_contacts<3>(mesh_of<3>({{{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}}}), {});
  EXPECT_EQ(set.semi_springs, 12);
  EXPECT_EQ(set.semi_edges, 12);
  EXPECT_TRUE(set.contacts.empty());
}

TEST(SemiSpring, LiesTheIndentationOfTheWayToTheCentreOfItsFace) {
  const Corners<3> corners{at(0, 0, 0), at(3, 0, 0), at(0, 6, 0)};
  const Point<3> point = weighted_point<3>(corners, semi_spring_weights<3>(1, 0.1));
  const Point<3> expected = corners[1] + 0.1 * (at(1, 2, 0) - corners[1]);
  EXPECT_NEAR((point - expected).norm(), 0, 1e-15);
}

TEST(SemiSpring, AreasOfAFaceSumToItsArea) {
  const auto mesh = mesh_of<3>({{{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}}});
  const auto surface = make_surface<3>(mesh);
  double sum = 0;
  for (const FaceId face : surface.faces.ids()) sum += 3 * semi_spring_area(surface, face);
  EXPECT_NEAR(sum, 1.5 + std::sqrt(3.0) / 2, 1e-14);
}

TEST(SemiEdge, JoinsItsTwoSemiSpringsAndHasTheirAreas) {
  EXPECT_EQ(semi_edge_weights(2, 0, 0.05), semi_spring_weights<3>(2, 0.05));
  EXPECT_EQ(semi_edge_weights(2, 1, 0.05), semi_spring_weights<3>(0, 0.05));
  const auto mesh = mesh_of<3>({{{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}}});
  const auto surface = make_surface<3>(mesh);
  for (const FaceId face : surface.faces.ids()) {
    EXPECT_DOUBLE_EQ(semi_edge_area(surface, face), surface.areas[face] * 2 / 3);
  }
}

TEST(Surface, OfABoxOfSixTetrahedraHasTwelveFacesAndEighteenEdges) {
  const auto mesh = mesh_of<3>({box<3>(at(0, 0, 0), at(1, 2, 3))});
  const auto surface = make_surface<3>(mesh);
  EXPECT_EQ(surface.faces.size(), 12);
  EXPECT_EQ(surface.edges.size(), 18);  // Euler: 8 - 18 + 12 = 2
  double area = 0;
  for (const FaceId face : surface.faces.ids()) {
    area += surface.areas[face];
    EXPECT_GT(surface.normals[face].dot(corners_of(surface, face)[0] - at(0.5, 1, 1.5)), 0) << "outwards";
  }
  EXPECT_NEAR(area, 22, 1e-13);
}

}  // namespace
}  // namespace scree::contact
