#include "contact/find_contacts.h"

#include <cmath>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "engine/mesh/make_blocks.h"
#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

// A cube of edge 1 and another beside it in x, moved by a gap and along the common face.
mesh::BlockMesh<3> two_cubes(double gap, double along) {
  return mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(1 + gap, along, 0), at(1, 1, 1))});
}

template <int dim>
double area_of(const ContactSet<dim>& set, Kind kind, std::size_t owner) {
  double sum = 0;
  for (const auto& contact : set.contacts) {
    if (contact.kind == kind && contact.owner == BlockId{owner}) sum += contact.area;
  }
  return sum;
}

TEST(FindContacts, OfTwoCubesFaceToFaceCarryTheWholeFaceFromBothSides) {
  const auto set = find_contacts<3>(two_cubes(0, 0), {});
  EXPECT_EQ(set.count(Kind::point_face), 12);  // two triangles a side, three semi-springs each
  EXPECT_EQ(set.count(Kind::edge_edge), 0);
  EXPECT_NEAR(area_of(set, Kind::point_face, 0), 1, 1e-14);
  EXPECT_NEAR(area_of(set, Kind::point_face, 1), 1, 1e-14);
  for (const auto& contact : set.contacts) EXPECT_NEAR(contact.gap, 0, 1e-15);
}

TEST(FindContacts, OfCubesThatAreOffsetLoseTheSemiSpringsBeyondTheRim) {
  // By half the face: each triangle keeps the corners that are over the other cube.
  const auto mesh = two_cubes(0, 0.5);
  const auto set = find_contacts<3>(mesh, {});
  EXPECT_GT(set.count(Kind::point_face), 0);
  EXPECT_LT(set.count(Kind::point_face), 12);
  EXPECT_EQ(set.count(Kind::edge_edge), 0) << "semi-springs have found this contact, semi-edges would count it again";
  for (const auto& contact : set.contacts) {
    EXPECT_GE(point_of(mesh, contact).y(), 0.5);
    EXPECT_LE(point_of(mesh, contact).y(), 1.0);
  }
}

TEST(FindContacts, EndWhereTheGapExceedsTheTolerance) {
  const double length = mesh::element_mean_edge(two_cubes(0, 0), ElementId{0});
  const ContactOptions options{0.05, 0.01};
  const auto within = find_contacts<3>(two_cubes(0.0099 * length, 0), options);
  EXPECT_EQ(within.count(Kind::point_face), 12);
  for (const auto& contact : within.contacts) EXPECT_NEAR(contact.gap, 0.0099 * length, 1e-14);
  EXPECT_TRUE(find_contacts<3>(two_cubes(0.0101 * length, 0), options).contacts.empty());
}

TEST(FindContacts, HaveANegativeGapWhereBlocksOverlap) {
  const auto set = find_contacts<3>(two_cubes(-0.005, 0), {});
  EXPECT_EQ(set.count(Kind::point_face), 12);
  for (const auto& contact : set.contacts) EXPECT_NEAR(contact.gap, -0.005, 1e-14);
}

TEST(FindContacts, DoNotSeeAThinBlockFromItsFarSide) {
  // A sheet of less than the tolerance lies between two blocks: its faces and theirs look at each other only where they
  // meet.
  const double sheet = 0.004;
  const auto mesh = mesh_of<3>(
      {box<3>(at(0, 0, -1), at(1, 1, 1)), box<3>(at(0, 0, 0), at(1, 1, sheet)), box<3>(at(0, 0, sheet), at(1, 1, 1))});
  const auto set = find_contacts<3>(mesh, {});
  for (const auto& contact : set.contacts) {
    EXPECT_GE(contact.gap, -1e-12) << "nothing overlaps here";
  }
  EXPECT_NEAR(area_of(set, Kind::point_face, 1), 2, 1e-12);
}

// A regular tetrahedron of edge 1 that stands on its corner at (0, 0, height).
Simplex<3> on_its_corner(double height) {
  const double up = std::sqrt(2.0 / 3), radius = 1 / std::sqrt(3.0);
  return {at(0, 0, height), at(radius, 0, height + up), at(-radius / 2, 0.5, height + up), at(-radius / 2, -0.5, height + up)};
}

TEST(FindContacts, OfAVertexOnAFaceAreTheThreeSemiSpringsAroundIt) {
  const auto floor = box<3>(at(-2, -2.1, -1), at(4.3, 4.4, 1));
  const auto mesh = mesh_of<3>({floor, {on_its_corner(0)}});
  const auto set = find_contacts<3>(mesh, {});
  ASSERT_EQ(set.contacts.size(), 3);
  for (const auto& contact : set.contacts) {
    EXPECT_EQ(contact.owner, BlockId{1});
    EXPECT_EQ(contact.target, BlockId{0});
    // 5 % of two thirds of the face's height, which leans by the tetrahedron's own.
    EXPECT_NEAR(contact.gap, 0.05 * 2.0 / 3 * std::sqrt(2.0 / 3), 1e-14);
    EXPECT_NEAR(contact.area, std::sqrt(3.0) / 12, 1e-14);
    const auto literal = literal_owner(contact);
    EXPECT_EQ(std::count(literal.weights.begin(), literal.weights.end(), 1.0), 1);
    EXPECT_NEAR(point_of(mesh, literal).norm(), 0, 1e-14) << "the corner it stands on";
    EXPECT_NEAR(point_of(mesh, contact.on_target).z(), 0, 1e-14);
  }
  EXPECT_TRUE(find_contacts<3>(mesh_of<3>({floor, {on_its_corner(0.011)}}), {}).contacts.empty());
}

// Two tetrahedra whose edges cross at right angles in the plane z = 0, one above and one below.
mesh::BlockMesh<3> crossed_edges(double gap) {
  const Simplex<3> below{at(-0.5, 0, 0), at(0.5, 0, 0), at(0, -0.5, -0.7), at(0, 0.5, -0.7)};
  const Simplex<3> above{at(0.1, -0.5, gap), at(0.1, 0.5, gap), at(-0.5, 0, 0.7 + gap), at(0.5, 0, 0.7 + gap)};
  return mesh_of<3>({{below}, {above}});
}

Point<3> centre_of(const mesh::BlockMesh<3>& mesh, const Stencil<3>& stencil) {
  return point_of(mesh, Stencil<3>{stencil.nodes, {}, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
}

TEST(FindContacts, OfCrossedEdgesAreSemiEdgesOfTheTwoFacesAtEach) {
  const auto mesh = crossed_edges(0.002);
  const auto set = find_contacts<3>(mesh, {});
  ASSERT_EQ(set.contacts.size(), 4);
  for (const auto& contact : set.contacts) {
    EXPECT_EQ(contact.kind, Kind::edge_edge);
    EXPECT_NE(contact.owner, contact.target);
    EXPECT_NEAR((point_of(mesh, contact.on_owner) - point_of(mesh, contact)).norm(), 0, 1e-14);
    EXPECT_NEAR(std::abs((point_of(mesh, contact) - point_of(mesh, contact.on_target)).z()), contact.gap, 1e-14);
    EXPECT_EQ(std::count(contact.on_target.weights.begin(), contact.on_target.weights.end(), 0.0), 1);
    EXPECT_NEAR(std::accumulate(contact.on_target.weights.begin(), contact.on_target.weights.end(), 0.0), 1, 1e-15);
    const auto literal = literal_owner(contact);
    EXPECT_EQ(std::count(literal.weights.begin(), literal.weights.end(), 0.0), 1);
    EXPECT_NEAR(std::accumulate(literal.weights.begin(), literal.weights.end(), 0.0), 1, 1e-15);
    // The semi-edge is moved inwards by 5 % of the way to its face's centre, which is across the edge.
    EXPECT_NEAR((0.95 * point_of(mesh, literal) + 0.05 * centre_of(mesh, literal) - point_of(mesh, contact.on_owner)).norm(), 0,
                1e-14);
    EXPECT_NEAR(point_of(mesh, literal).head<2>().norm(), 0.1, 0.01) << "beside the crossing, on the edge itself";
  }
  EXPECT_TRUE(find_contacts<3>(crossed_edges(0.011), {}).contacts.empty());
}

TEST(FindContacts, OfABeamAcrossABeamAreSemiEdges) {
  // No corner of either lies on the other: semi-springs alone would lose this contact.
  const auto mesh = mesh_of<3>({box<3>(at(-2, -0.3, -1), at(4, 0.6, 1)), box<3>(at(-0.31, -2, 0), at(0.6, 4, 1))});
  const auto set = find_contacts<3>(mesh, {});
  EXPECT_EQ(set.count(Kind::point_face), 0);
  EXPECT_GT(set.count(Kind::edge_edge), 0);
  for (const auto& contact : set.contacts) EXPECT_NEAR(point_of(mesh, contact).z(), 0, 1e-14);
}

TEST(FindContacts, NeverJoinABlockToItself) {
  std::mt19937 random(3);
  const auto mesh = each_its_own<3>(random_simplices<3>(60, 1.0, 0.5, random));
  for (const auto& contact : find_contacts<3>(mesh, {0.05, 0.2}).contacts) EXPECT_NE(contact.owner, contact.target);
  EXPECT_TRUE(find_contacts<3>(mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 0.001))}), {0.05, 0.1}).contacts.empty());
}

TEST(FindContacts, OfTheRingOf960TrianglesAreAllButTheRims) {
  const auto mesh = each_its_own<2>(ring());
  const auto set = find_contacts<2>(mesh, {});
  EXPECT_EQ(set.semi_springs, 5760);
  EXPECT_EQ(set.contacts.size(), 5760 - 2 * 60 * 2);
  for (const auto& contact : set.contacts) EXPECT_NEAR(contact.gap, 0, 1e-12);
}

// A film of two thousandths of the cubes' edge between them: what the semi-springs of a cube find is the film, and a semi-edge
// must not take the edges behind it instead.
TEST(FindContacts, DoNotReachThroughAFilmThatLiesBetween) {
  const auto layer = [](int cells, double low, double thickness) {
    BlockOf<3> simplices;
    for (int i = 0; i < cells * cells; ++i) {
      const Point<3> corner(double(i % cells) / cells, double(i / cells) / cells, low);  // NOLINT(bugprone-integer-division)
      for (const auto& simplex : box<3>(corner, Point<3>(1.0 / cells, 1.0 / cells, thickness))) simplices.push_back(simplex);
    }
    return simplices;
  };
  const auto set = find_contacts<3>(mesh_of<3>({layer(3, -0.4, 0.4), layer(2, 0, 0.002), layer(4, 0.002, 0.4)}), {0.05, 0.05});
  std::map<std::pair<std::size_t, std::size_t>, int> between;
  for (const auto& contact : set.contacts) ++between[std::minmax(contact.owner.index(), contact.target.index())];
  EXPECT_GT((between[{0, 1}]), 0);
  EXPECT_GT((between[{1, 2}]), 0);
  EXPECT_EQ((between[{0, 2}]), 0);
}

TEST(FindContacts, OfACubeOfLooseTetrahedraAreAllInnerFacesAndNoSemiEdges) {
  BlockOf<3> tetrahedra;
  for (int i = 0; i < 27; ++i) {
    const auto cell = box<3>(at(i % 3, i / 3 % 3, i / 9), at(1, 1, 1));
    tetrahedra.insert(tetrahedra.end(), cell.begin(), cell.end());
  }
  const auto set = find_contacts<3>(each_its_own<3>(tetrahedra), {});
  EXPECT_EQ(set.semi_springs, 27 * 6 * 12);
  EXPECT_EQ(set.count(Kind::point_face), 27 * 6 * 12 - 6 * 9 * 2 * 3);
  EXPECT_EQ(set.count(Kind::edge_edge), 0);
}

// As a mesher makes them, of all shapes: edges that share a corner only do not cross.
TEST(FindContacts, OfAMeshThatConformsAreNoSemiEdges) {
  for (const double size : {0.8, 0.5}) {
    mesh::BodySpec body;
    body.name = "box";
    body.shape = mesh::Box{.size = {1, 0.8, 1.1}};
    body.mesh_size = size;
    body.blocks = mesh::BlockRule::per_element;
    body.material = MaterialId{0};
    const auto set = find_contacts<3>(mesh::make_blocks<3>({body}), {});
    EXPECT_GT(set.count(Kind::point_face), 100) << size;
    EXPECT_EQ(set.count(Kind::edge_edge), 0) << size;
  }
}

TEST(FindContacts, ComeInTheOrderOfOwners) {
  const auto set = find_contacts<2>(each_its_own<2>(ring()), {});
  EXPECT_TRUE(
      std::is_sorted(set.contacts.begin(), set.contacts.end(), [](const auto& a, const auto& b) { return a.owner < b.owner; }));
}

}  // namespace
}  // namespace scree::contact
