// Overlaps of faces against closed forms.
#include "contact/overlap.h"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

const ContactOptions by_overlap{0.05, 0.01, Model::overlap, {}};

template <int dim>
double area_of(const ContactSet<dim>& set) {
  double sum = 0;
  for (const auto& contact : set.contacts) sum += contact.area;
  return sum;
}

// A cube of edge 1 on z = 0 .. 1 under a flat box whose lower face is the unit square turned and moved.
double area_on_cube(double angle, const Point<3>& shift) {
  auto upper = box<3>(at(-0.5, -0.5, 0), at(1, 1, 1));
  const Eigen::AngleAxisd turn(angle, Point<3>::UnitZ());
  for (auto& simplex : upper) {
    for (auto& corner : simplex) corner = turn * corner + shift;
  }
  return area_of(find_contacts<3>(mesh_of<3>({box<3>(at(-0.5, -0.5, -1), at(1, 1, 1)), upper}), by_overlap));
}

TEST(Overlap, OfShiftedSquaresIsTheRectangleTheyShare) {
  for (const double x : {0.0, 0.1, 0.5, 0.99}) {
    for (const double y : {0.0, -0.3, 0.7}) {
      EXPECT_NEAR(area_on_cube(0, {x, y, 0}), (1 - x) * (1 - std::abs(y)), 1e-13) << x << " " << y;
    }
  }
  EXPECT_EQ(area_on_cube(0, {1.001, 0, 0}), 0);
}

// Two unit squares about one centre, turned by a: each corner loses a right-angled triangle, together
// 1 - 2 s c / (1 + s + c)^2 with s, c the sine and cosine of a.
TEST(Overlap, OfTurnedSquaresIsTheOctagonTheyShare) {
  for (const double angle : {0.01, 0.3, M_PI / 4, 1.2}) {
    const double s = std::sin(angle), c = std::cos(angle);
    EXPECT_NEAR(area_on_cube(angle, {0, 0, 0}), 1 - 2 * s * c / std::pow(1 + s + c, 2), 1e-13) << angle;
  }
}

TEST(Overlap, IntegratesProductsOfLinearFunctionsOverANestedTriangle) {
  const Corners<3> outer{at(-3, -2, 0), at(4, -1, 0), at(0, 5, 0)};
  const Corners<3> inner{at(0, 0, 0), at(0, 1, 0), at(1, 0, 0)};
  std::vector<OverlapPoint<3>> points;
  for (const bool inner_first : {true, false}) {
    const auto pair = inner_first ? opposed_faces<3>(inner, {0, 0, -1}, outer, {0, 0, 1})
                                  : opposed_faces<3>(outer, {0, 0, 1}, inner, {0, 0, -1});
    overlap_points(pair.value(), 0.01, points);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (const auto& point : points) {
          const auto& weights = inner_first ? point.on_first : point.on_second;
          sum += point.area * weights[i] * weights[j];
        }
        EXPECT_NEAR(sum, 0.5 * (i == j ? 2 : 1) / 12, 1e-14);
      }
    }
  }
}

// The integral of f over the convex polygon by the middles of the sides of its triangles, exact for quadratic functions.
double integral(const std::vector<Point<3>>& corners, const auto& f) {
  double sum = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Point<3>&a = corners[0], &b = corners[i - 1], &c = corners[i];
    sum += 0.5 * (b - a).cross(c - a).norm() / 3 * (f(0.5 * (a + b)) + f(0.5 * (b + c)) + f(0.5 * (c + a)));
  }
  return sum;
}

// Two equilateral triangles about one centre, turned by 180 degrees: a regular hexagon. Stretched, so that no way is like
// another.
TEST(Overlap, IntegratesProductsOfLinearFunctionsOverAHexagonByThreePointsWithinIt) {
  const auto placed = [](double angle, double radius) {
    return Point<3>(3 * radius * std::cos(angle) + 0.4 * radius * std::sin(angle), 0.5 * radius * std::sin(angle), 0);
  };
  Corners<3> first, second;
  for (int i = 0; i < 3; ++i) first[i] = placed(2 * M_PI * i / 3, 1), second[i] = placed(M_PI - 2 * M_PI * i / 3, 1);
  std::vector<Point<3>> hexagon;
  for (int i = 0; i < 6; ++i) hexagon.push_back(placed(M_PI * (2 * i + 1) / 6, 1 / std::sqrt(3.0)));

  std::vector<OverlapPoint<3>> points;
  overlap_points(opposed_faces<3>(first, {0, 0, 1}, second, {0, 0, -1}).value(), 0.01, points);
  ASSERT_EQ(points.size(), 3);
  for (const auto& point : points) {
    EXPECT_NEAR((weighted_point<3>(first, point.on_first) - weighted_point<3>(second, point.on_second)).norm(), 0, 1e-14);
    for (int i = 0; i < 3; ++i) EXPECT_GT(std::min(point.on_first[i], point.on_second[i]), 0);
  }
  for (const auto& f : {+[](const Point<3>&) { return 1.0; }, +[](const Point<3>& at) { return at.x() * at.x(); },
                        +[](const Point<3>& at) { return at.x() * at.y() + at.x(); },
                        +[](const Point<3>& at) { return at.y() * at.y() - at.y(); }}) {
    double sum = 0;
    for (const auto& point : points) sum += point.area * f(weighted_point<3>(first, point.on_first));
    EXPECT_NEAR(sum, integral(hexagon, f), 1e-14);
  }
}

// Triangles at random: whatever they have in common, the points lie in both, and each has its share.
TEST(Overlap, HasItsPointsWithinBothFaces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  std::vector<OverlapPoint<3>> points;
  int overlaps = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Corners<3> first, second;
    for (int i = 0; i < 3; ++i) {
      first[i] = at(anywhere(random), anywhere(random), 0);
      second[i] = at(anywhere(random), anywhere(random), 0);
    }
    overlap_points(opposed_faces<3>(first, {0, 0, 1}, second, {0, 0, -1}).value(), 0.01, points);
    overlaps += points.empty() ? 0 : 1;
    for (const auto& point : points) {
      EXPECT_EQ(point.area, points[0].area);
      for (int i = 0; i < 3; ++i) EXPECT_GT(std::min(point.on_first[i], point.on_second[i]), 0);
      EXPECT_NEAR((weighted_point<3>(first, point.on_first) - weighted_point<3>(second, point.on_second)).norm(), 0, 1e-12);
    }
  }
  EXPECT_GT(overlaps, 1000);
}

TEST(Overlap, IntegratesProductsOfLinearFunctionsOverAPartOfASegment) {
  // [0, 2] and [1, 5] on one line: there the weights are x/2 and (x - 1)/4.
  const Corners<2> first{Point<2>(0, 0), Point<2>(2, 0)}, second{Point<2>(5, 0), Point<2>(1, 0)};
  std::vector<OverlapPoint<2>> points;
  overlap_points(opposed_faces<2>(first, {0, -1}, second, {0, 1}).value(), 0.01, points);
  ASSERT_EQ(points.size(), 2);
  double area = 0, product = 0;
  for (const auto& point : points) {
    area += point.area;
    product += point.area * point.on_first[1] * point.on_second[0];
  }
  EXPECT_NEAR(area, 1, 1e-15);
  // Integral of x/2 (x - 1)/4 from 1 to 2: (7/3 - 3/2)/8.
  EXPECT_NEAR(product, (7.0 / 3 - 1.5) / 8, 1e-15);
}

// Two blocks of one interface, meshed 5 and 7 cells across, shifted so that nothing fits.
template <int dim>
BlockOf<dim> layer(int cells, double low) {
  BlockOf<dim> all;
  const double size = 1.0 / cells;
  Point<dim> corner = Point<dim>::Zero();
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < (dim == 3 ? cells : 1); ++j) {
      corner[0] = i * size;
      if (dim == 3) corner[1] = j * size;
      corner[dim - 1] = low;
      const auto cell = box<dim>(corner, Point<dim>::Constant(size));
      all.insert(all.end(), cell.begin(), cell.end());
    }
  }
  return all;
}

template <int dim>
void non_matching() {
  const auto lower = layer<dim>(5, -0.2);
  const auto upper = layer<dim>(7, 0);
  EXPECT_NEAR(area_of(find_contacts<dim>(mesh_of<dim>({lower, upper}), by_overlap)), 1, 1e-12);
}

TEST(Overlap, OfNonMatchingMeshesSumsUpToTheirInterface) {
  non_matching<2>();
  non_matching<3>();
}

TEST(Overlap, EndsWhereTheGapExceedsTheTolerance) {
  // A face of 1 m that opens by 0.02 rad about one of its edges: within 0.005 m up to x = 0.25.
  const double slope = 0.02;
  const Corners<2> first{Point<2>(1, 0), Point<2>(0, 0)}, second{Point<2>(0, 0), Point<2>(1, slope)};
  std::vector<OverlapPoint<2>> points;
  overlap_points(opposed_faces<2>(first, {0, 1}, second, Point<2>(slope, -1).normalized()).value(), 0.005, points);
  double area = 0;
  for (const auto& point : points) {
    area += point.area;
    EXPECT_GT(point.gap, 0);
    EXPECT_LT(point.gap, 0.005);
  }
  EXPECT_NEAR(area, 0.25, 1e-3);
}

TEST(Overlap, DoesNotReachThroughAThinPlate) {
  // A large floor, a plate of 5 mm and a cube of 10 cm on it; 1 % of the floor's elements would be 1 cm and more.
  const auto mesh = mesh_of<3>({box<3>(at(-1, -1, -1), at(2, 2, 1)), box<3>(at(-0.2, -0.2, 0), at(0.4, 0.4, 0.005)),
                                box<3>(at(-0.05, -0.05, 0.005), at(0.1, 0.1, 0.1))});
  for (const auto& contact : find_contacts<3>(mesh, by_overlap).contacts) {
    EXPECT_EQ(contact.target.value() - contact.owner.value(), 1);
  }
}

TEST(Overlap, IsSearchedOnlyForThePairsOfBodiesThatAskForIt) {
  auto mesh =
      mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(1, 0, 0), at(1, 1, 1)), box<3>(at(2, 0, 0), at(1, 1, 1))});
  for (std::size_t i = 1; i < 3; ++i) {
    mesh.bodies.push_back({"body", MaterialId{0}, false, Eigen::Vector3d::Zero()});
    mesh.blocks[BlockId{i}].body = BodyId{i};
  }
  ContactOptions options;
  options.pairs = Table<BodyId, Table<BodyId, Model>>(3, Table<BodyId, Model>(3, Model::none));
  options.pairs[BodyId{0}][BodyId{1}] = options.pairs[BodyId{1}][BodyId{0}] = Model::overlap;
  const auto only_first = find_contacts<3>(mesh, options);
  EXPECT_NEAR(area_of(only_first), 1, 1e-13);
  EXPECT_EQ(only_first.semi_springs, 0);
  options.pairs[BodyId{1}][BodyId{2}] = options.pairs[BodyId{2}][BodyId{1}] = Model::semi_spring;
  const auto both = find_contacts<3>(mesh, options);
  EXPECT_NEAR(area_of(both), 1 + 2, 1e-13) << "semi-springs count from both sides";
  for (const auto& contact : both.contacts) {
    const bool second_joint = contact.owner == BlockId{2} || contact.target == BlockId{2};
    EXPECT_EQ(contact.kind, second_joint ? Kind::point_face : Kind::overlap);
  }
}

template <int dim>
void same_when_renumbered_and_moved() {
  auto lower = layer<dim>(3, -1.0 / 3), upper = layer<dim>(4, 0);
  const auto before_mesh = mesh_of<dim>({lower, upper});
  const auto before = find_contacts<dim>(before_mesh, by_overlap);
  Eigen::Matrix<double, dim, dim> rotation;
  if constexpr (dim == 2) {
    rotation = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  } else {
    rotation = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized().toRotationMatrix();
  }
  const auto moved = [&](BlockOf<dim> block) {
    std::mt19937 random(1);
    std::shuffle(block.begin(), block.end(), random);
    for (auto& simplex : block) {
      std::shuffle(simplex.begin(), simplex.end(), random);
      for (auto& corner : simplex) corner = rotation * corner + Point<dim>::Constant(-12.3);
    }
    return block;
  };
  const auto after_mesh = mesh_of<dim>({moved(upper), moved(lower)});
  const auto after = find_contacts<dim>(after_mesh, by_overlap);
  EXPECT_NEAR(area_of(before), area_of(after), 1e-12);
  // The second moments of the points are those of the moved ones, however the polygons are divided.
  Eigen::Matrix<double, dim, dim> sum = Eigen::Matrix<double, dim, dim>::Zero(), moved_sum = sum;
  for (const auto& contact : before.contacts) {
    const Point<dim> point = rotation * point_of(before_mesh, contact) + Point<dim>::Constant(-12.3);
    sum += contact.area * point * point.transpose();
  }
  for (const auto& contact : after.contacts) {
    const Point<dim> point = point_of(after_mesh, contact);
    moved_sum += contact.area * point * point.transpose();
  }
  EXPECT_NEAR((sum - moved_sum).norm(), 0, 1e-9);
}

TEST(Overlap, DependsOnNeitherNumberingNorAMotionOfTheWhole) {
  same_when_renumbered_and_moved<2>();
  same_when_renumbered_and_moved<3>();
}

TEST(Overlap, AreasPerPairOfBodiesAreTrueOnesWhateverTheModel) {
  const auto mesh = mesh_of<3>({layer<3>(5, -0.2), layer<3>(7, 0)});
  for (const Model model : {Model::overlap, Model::semi_spring}) {
    ContactOptions options;
    options.model = model;
    const auto areas = overlap_areas<3>(mesh, find_contacts<3>(mesh, options), options);
    ASSERT_EQ(areas.size(), 1);
    EXPECT_NEAR(areas.at({BodyId{0}, BodyId{0}}), 1, 1e-12);
  }
}

// A film of two thousandths of the cubes' edge between them, thinner than what the tolerance reaches over.
TEST(Overlap, DoesNotReachThroughAFilmThatLiesBetween) {
  for (const double off : {0.0, 0.0005}) {  // off the film
    const auto mesh = mesh_of<3>(
        {box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(0, 0, 1), at(1, 1, 0.002)), box<3>(at(0, 0, 1.002 + off), at(1, 1, 1))});
    std::map<std::pair<BlockId, BlockId>, double> areas;
    for (const auto& contact : find_contacts<3>(mesh, by_overlap).contacts) {
      areas[std::minmax(contact.owner, contact.target)] += contact.area;
    }
    EXPECT_EQ(areas.size(), 2);
    EXPECT_NEAR((areas[{BlockId{0}, BlockId{1}}]), 1, 1e-12);
    EXPECT_NEAR((areas[{BlockId{1}, BlockId{2}}]), 1, 1e-12);
  }
}

// Whatever the model of its own joints: what lies between need not have a contact.
TEST(Overlap, DoesNotReachThroughAFilmWhoseJointsAreOfAnotherModel) {
  auto mesh = mesh_of<3>(
      {box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(0, 0, 1), at(1, 1, 0.002)), box<3>(at(0, 0, 1.002), at(1, 1, 1))});
  mesh.bodies = Table<BodyId, mesh::Body>(3);
  for (const BlockId block : mesh.blocks.ids()) mesh.blocks[block].body = BodyId{block.index()};
  for (const Model of_film : {Model::none, Model::semi_spring}) {
    ContactOptions options = by_overlap;
    options.pairs = Table<BodyId, Table<BodyId, Model>>(3, Table<BodyId, Model>(3, of_film));
    options.pairs[BodyId{0}][BodyId{2}] = options.pairs[BodyId{2}][BodyId{0}] = Model::overlap;
    for (const auto& contact : find_contacts<3>(mesh, options).contacts) {
      EXPECT_TRUE(contact.owner == BlockId{1} || contact.target == BlockId{1});
    }
  }
}

// A film that covers a half of the face hides that half.
TEST(Overlap, OfWhatAFilmLeavesFreeIsFound) {
  const auto mesh = mesh_of<3>(
      {box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(0, 0, 1), at(0.5, 1, 0.002)), box<3>(at(0, 0, 1.002), at(1, 1, 1))});
  double past = 0;
  for (const auto& contact : find_contacts<3>(mesh, by_overlap).contacts) {
    if (contact.owner == BlockId{0} && contact.target == BlockId{2}) past += contact.area;
  }
  EXPECT_NEAR(past, 0.5, 0.1) << "by the quadrature points that are free";
}

// Two triangular blocks that fill a thin plate, on a floor: the slanted face between them is within 10 degrees of the floor's.
TEST(Overlap, OfAFloorWithAThinPlateInPiecesIsThePlatesArea) {
  const std::vector<Simplex<2>> left{{Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 0.05)}};
  const std::vector<Simplex<2>> right{{Point<2>(1, 0), Point<2>(1, 0.05), Point<2>(0, 0.05)}};
  const auto mesh = mesh_of<2>({left, right, box<2>(Point<2>(0, -1), Point<2>(1, 1))});
  double floor = 0;
  for (const auto& contact : find_contacts<2>(mesh, by_overlap).contacts) {
    floor += contact.target == BlockId{2} || contact.owner == BlockId{2} ? contact.area : 0;
  }
  EXPECT_NEAR(floor, 1, 1e-3);
}

// The same plate pressed into the floor: at the tip of the lower piece, which is thinner than that is deep, the slanted face of
// the other is in the floor as well.
TEST(Overlap, OfAFloorWithAThinPlateInPiecesThatIsPressedIntoItIsThePlatesArea) {
  for (const double depth : {0.001, 0.004}) {
    const std::vector<Simplex<2>> left{{Point<2>(0, -depth), Point<2>(1, -depth), Point<2>(0, 0.05 - depth)}};
    const std::vector<Simplex<2>> right{{Point<2>(1, -depth), Point<2>(1, 0.05 - depth), Point<2>(0, 0.05 - depth)}};
    const auto mesh = mesh_of<2>({left, right, box<2>(Point<2>(0, -1), Point<2>(1, 1))});
    double floor = 0;
    for (const auto& contact : find_contacts<2>(mesh, by_overlap).contacts) {
      floor += contact.target == BlockId{2} || contact.owner == BlockId{2} ? contact.area : 0;
    }
    EXPECT_NEAR(floor, 1, 2e-3) << depth;
  }
}

// Four triangles that meet in a joint along x = 0, the upper right one lower by a little than the lower left one is high: their
// slanted faces are opposed, seen along their normals over each other, and neither is in the other's block.
TEST(Overlap, OfSlantedFacesOnBothSidesOfAJointIsNone) {
  const double off = 0.005;
  const std::vector<Simplex<2>> lower_left{{Point<2>(-1, 0), Point<2>(0, 0), Point<2>(0, 0.5)}};
  const std::vector<Simplex<2>> upper_left{{Point<2>(-1, 0), Point<2>(0, 0.5), Point<2>(0, 1)}};
  const std::vector<Simplex<2>> lower_right{{Point<2>(0, 0), Point<2>(1, 1), Point<2>(0, 0.5 - off)}};
  const std::vector<Simplex<2>> upper_right{{Point<2>(0, 0.5 - off), Point<2>(1, 1), Point<2>(0, 1)}};
  const auto mesh = mesh_of<2>({lower_left, upper_left, lower_right, upper_right});
  double joint = 0;
  for (const auto& contact : find_contacts<2>(mesh, by_overlap).contacts) {
    const bool across = (contact.owner.index() < 2) != (contact.target.index() < 2);
    joint += across ? contact.area : 0;
  }
  EXPECT_NEAR(joint, 1, 1e-12);
}

}  // namespace
}  // namespace scree::contact
