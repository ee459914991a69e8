// The effective conductivity of jointed rock against k/(1 + k/(hL)), and its bounds in order.
#include "thermal/effective_conductivity.h"

#include <gtest/gtest.h>

#include "engine/mesh/make_blocks.h"
#include "tests/thermal/builders.h"
#include "thermal/joint_conduction.h"

namespace scree::thermal {
namespace {

constexpr double k = 4;       // of the test rock [W/m/K]
constexpr double edge = 0.1;  // of a block [m]
constexpr double beta = 0.2;

template <int dim>
struct JointedRock {
  mesh::BlockMesh<dim> mesh;
  contact::ContactSet<dim> contacts;
  HeatModel model;
  double joint = 0;  // conductance of each joint [W/m2/K]
};

// Cubes (squares) of two cells an edge, `count` along each axis, with matching meshes.
template <int dim>
JointedRock<dim> jointed_rock(int count, double stiffness) {
  std::vector<test::Slab<dim>> cubes;
  const int blocks = dim == 2 ? count * count : count * count * count;
  for (int i = 0; i < blocks; ++i) {
    test::Slab<dim> cube;
    cube.size.setConstant(edge);
    cube.cells.fill(2);
    for (int axis = 0, rest = i; axis < dim; ++axis, rest /= count) cube.low[axis] = edge * (rest % count);
    cubes.push_back(cube);
  }
  JointedRock<dim> rock;
  rock.mesh = test::slab_mesh<dim>(cubes);
  rock.contacts = test::matching_contacts(rock.mesh);
  HeatOptions options = test::options_for(rock.mesh, 300);
  options.joint.law = StiffnessFactor{stiffness};
  rock.model = make_heat_model(rock.mesh, test::rock_only(), rock.contacts, options);
  double conductance = 0;
  for (const double g : joint_conduction(rock.mesh, test::rock_only(), rock.contacts, options.joint).conductances)
    conductance += g;
  double area = dim * (count - 1) * std::pow(count * edge, dim - 1);
  rock.joint = conductance / area;
  return rock;
}

template <int dim>
Aabb<dim> window(double low, double high) {
  return {Point<dim>::Constant(low), Point<dim>::Constant(high)};
}

template <class Dim>
class Homogenised : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Homogenised, Dimensions);

TYPED_TEST(Homogenised, JointedCubesConductAsTheClosedFormSaysAlongEveryAxis) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(4, beta);
  // From the middle of the first cubes to that of the last: as many joints as edges.
  const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(edge / 2, 3.5 * edge));
  const double expected = k / (1 + k / (rock.joint * edge));
  EXPECT_LT(expected, 0.9 * k);
  for (int axis = 0; axis < dim; ++axis) EXPECT_NEAR(found.along[axis] / expected, 1, 1e-9) << axis;
  EXPECT_NEAR(found.solid_fraction, 1, 1e-12);
  EXPECT_FALSE(found.lower) << "the sides run through blocks";
}

// As many joints as edges, wherever it begins: what lies beyond its sides and is held there is not taken for a part of it.
TYPED_TEST(Homogenised, JointedCubesConductTheSameInAWindowThatCutsElements) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(4, beta);
  const double expected = k / (1 + k / (rock.joint * edge));
  for (const double low : {0.1, 0.25, 0.4, 0.7, 0.85}) {
    const auto found =
        effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(low * edge, (low + 3) * edge));
    for (int axis = 0; axis < dim; ++axis) EXPECT_NEAR(found.along[axis] / expected, 1, 1e-9) << low << ", " << axis;
    EXPECT_GT(found.upper(0, 0), 1.1 * expected) << low;
    EXPECT_LT(found.upper(0, 0), found.volume_mean) << low;
  }
}

TYPED_TEST(Homogenised, BoundsHoldTheMeasurementBetweenThem) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(3, beta);
  const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(0, 3 * edge));
  ASSERT_TRUE(found.lower);
  // Three cubes and two joints in a row.
  const double series = 3 * edge / (3 * edge / k + 2 / rock.joint);
  for (int axis = 0; axis < dim; ++axis) {
    EXPECT_NEAR((*found.lower)(axis, axis) / series, 1, 1e-9);
    EXPECT_NEAR(found.along[axis] / series, 1, 1e-9);
    EXPECT_GT(found.upper(axis, axis), found.along[axis]);
    EXPECT_LT(found.upper(axis, axis), found.volume_mean);
  }
  EXPECT_NEAR(found.volume_mean, k, 1e-12);
  EXPECT_LT((found.upper - found.upper.transpose()).norm(), 1e-9);
}

// A bond of bricks whose joints heat does not cross straight on, in a window that cuts elements of all of them: 4 % off on the
// coarse mesh if what lies beyond the window counts as a part of it.
TEST(EffectiveConductivity, OfABondOfBricksComesNearInAWindowThatCutsElements) {
  const auto along = [](int cells) {
    std::vector<test::Slab<2>> bricks(24);
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      bricks[i].size = {0.2, 0.1};
      bricks[i].cells = {2 * cells, cells};
      const std::size_t row = i / 4;
      bricks[i].low = {0.2 * static_cast<double>(i % 4) + (row % 2 == 1 ? 0.1 : 0.0), 0.1 * static_cast<double>(row)};
    }
    const auto mesh = test::slab_mesh<2>(bricks);
    HeatOptions options = test::options_for(mesh, 300);
    options.joint.law = JointConductance{60};
    const auto model = make_heat_model(mesh, test::rock_only(), contact::find_contacts(mesh, {}), options);
    return effective_conductivity<2>(mesh, test::rock_only(), model, {Point<2>(0.23, 0.17), Point<2>(0.63, 0.47)}).along;
  };
  const Point<2> fine = along(16);
  EXPECT_LT((along(2) - fine).cwiseAbs().maxCoeff(), 0.01 * k) << along(2).transpose() << " beside " << fine.transpose();
}

// Metal, felt and metal in a row, between sides that cut elements of the metal: the flux in these is one between nodes that are
// held, and up to 0.6 times too much with it.
TEST(EffectiveConductivity, ALayerThatInsulatesDoesSoInAWindowThatCutsElementsBesideIt) {
  Table<MaterialId, Material> materials({test::rock(), test::rock()});
  materials[MaterialId{0}].conductivity = 20.0;
  materials[MaterialId{1}].conductivity = 0.2;
  const double series = 0.36 / (0.13 / 20 + 0.1 / 0.2 + 0.13 / 20 + 2.0 / 1000);
  for (const int cells : {3, 6, 12}) {
    std::vector<test::Slab<2>> layers(3, test::bar<2>(0.3, cells, cells, 0.3));
    layers[1] = test::bar<2>(0.1, 2, 6, 0.3);
    layers[1].low[0] = 0.3;
    layers[1].material = MaterialId{1};
    layers[2].low[0] = 0.4;
    auto mesh = test::slab_mesh<2>(layers);
    const double cell = 0.3 / cells;
    for (Point<2>& node : mesh.nodes) {  // in the metal, so that held nodes of an element differ along the axis
      const double within = std::fmod(node.x(), 0.4);
      if (within > 1e-6 && within < 0.3 - 1e-6) node.x() += 0.3 * cell * std::sin(2.5 * node.y() / cell);
    }
    HeatOptions options = test::options_for(mesh, 300);
    options.joint.law = JointConductance{1000};
    const auto model = make_heat_model(mesh, materials, contact::find_contacts(mesh, {}), options);
    const auto along = [&](double high) {
      const Aabb<2> window{Point<2>(0.17, 0), Point<2>(0.53, high)};
      return effective_conductivity<2>(mesh, materials, model, window).along[0] / series;
    };
    EXPECT_NEAR(along(0.3), 1, 0.03) << cells;
    EXPECT_NEAR(along(0.17), 1, 0.16) << cells << ", where heat passes beside the window, too";
  }
}

// What a joint of 1e9 times an element's conductance loses in rounding is put right; where that cannot be done, no lower bound.
TYPED_TEST(Homogenised, StiffJointsLeaveALowerBoundThatIsOneOrNone) {
  constexpr int dim = TypeParam::value;
  for (const double stiffness : {1e6, 1e9, 1e12}) {
    const auto rock = jointed_rock<dim>(3, stiffness);
    const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(0, 3 * edge));
    for (int axis = 0; axis < dim; ++axis) EXPECT_NEAR(found.along[axis], k, 1e-5 * k) << stiffness;
    ASSERT_EQ(found.lower.has_value(), stiffness < 1e10) << stiffness;
    if (stiffness < 1e10) {
      EXPECT_NEAR((*found.lower)(0, 0), k, 1e-5 * k) << stiffness;
    }
  }
}

TYPED_TEST(Homogenised, SolidRockIsItself) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(1, beta);
  const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(0, edge));
  const auto tensor = EffectiveConductivity<dim>::Tensor::Identity() * k;
  EXPECT_LT((found.upper - tensor).norm(), 1e-9);
  ASSERT_TRUE(found.lower);
  EXPECT_LT((*found.lower - tensor).norm(), 1e-9);
}

// The sides cut elements anyhow.
TYPED_TEST(Homogenised, SolidRockIsItselfInAWindowThatFollowsNoFaces) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(1, beta);
  const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(0.013, 0.081));
  EXPECT_NEAR(found.solid_fraction, 1, 1e-12);
  EXPECT_NEAR(found.volume_mean, k, 1e-12);
  EXPECT_LT((found.upper - EffectiveConductivity<dim>::Tensor::Identity() * k).norm(), 1e-9);
  for (int axis = 0; axis < dim; ++axis) EXPECT_NEAR(found.along[axis], k, 1e-9);
}

TYPED_TEST(Homogenised, AnisotropicRockHasTheMeanOfItsAxes) {
  constexpr int dim = TypeParam::value;
  auto rock = jointed_rock<dim>(1, beta);
  Table<MaterialId, Material> materials = test::rock_only();
  materials[MaterialId{0}].conductivity->ratio = {1, 2, 6};
  rock.model = make_heat_model(rock.mesh, materials, rock.contacts, test::options_for(rock.mesh, 300));
  const auto found = effective_conductivity(rock.mesh, materials, rock.model, window<dim>(0, edge));
  EXPECT_NEAR(found.volume_mean, k * (dim == 2 ? 1.5 : 3), 1e-12);
  EXPECT_NEAR(found.upper.trace() / dim, found.volume_mean, 1e-9);
  EXPECT_NEAR(found.along[1], 2 * k, 1e-9);
}

TYPED_TEST(Homogenised, AWindowThatReachesBeyondTheRockIsFilledByItsShare) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(1, beta);
  const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(-0.013, 0.081));
  EXPECT_NEAR(found.solid_fraction, std::pow(0.081 / 0.094, dim), 1e-12);
}

TYPED_TEST(Homogenised, BlocksThatTouchNothingConductNothing) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(3, 0);
  const auto found = effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(0, 3 * edge));
  for (int axis = 0; axis < dim; ++axis) EXPECT_NEAR(found.along[axis], 0, 1e-9);
  EXPECT_FALSE(found.lower);  // no uniform flux passes
}

// Of two squares (cubes) apart, in one plane: what lies outside the window counts neither as its side nor as a way round it.
TYPED_TEST(Homogenised, OneOfTwoSolidsInAPlaneIsItself) {
  constexpr int dim = TypeParam::value;
  std::vector<test::Slab<dim>> cubes(2);
  for (test::Slab<dim>& cube : cubes) {
    cube.size.setConstant(edge);
    cube.cells.fill(2);
  }
  cubes[1].low[0] = 3 * edge;
  const auto mesh = test::slab_mesh<dim>(cubes);
  const auto model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<dim>(), test::options_for(mesh, 300));
  const auto found = effective_conductivity(mesh, test::rock_only(), model, window<dim>(0, edge));
  ASSERT_TRUE(found.lower);
  EXPECT_LT((*found.lower - k * EffectiveConductivity<dim>::Tensor::Identity()).norm(), 1e-9);
}

TYPED_TEST(Homogenised, AWindowThatBlocksAroundItAreJoinedWithHasNoLowerBound) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(3, beta);
  EXPECT_FALSE(effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(edge, 2 * edge)).lower);
}

// Faces on the planes of all sides, but none on a side.
TEST(EffectiveConductivity, ACrossOfBlocksAroundAWindowIsNoneOfItsSides) {
  std::vector<test::Slab<2>> squares(3);
  for (test::Slab<2>& square : squares) square.cells.fill(2);
  squares[0].low = {0.4, 0.4};
  squares[0].size = {0.2, 0.2};
  squares[1].low = {0, 5};
  squares[2].low = {5, 0};
  const auto mesh = test::slab_mesh<2>(squares);
  const auto model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<2>(), test::options_for(mesh, 300));
  EXPECT_FALSE(effective_conductivity(mesh, test::rock_only(), model, window<2>(0, 1)).lower);
}

TYPED_TEST(Homogenised, AWindowWithoutAnElementIsRefused) {
  constexpr int dim = TypeParam::value;
  const auto rock = jointed_rock<dim>(1, beta);
  EXPECT_THROW(effective_conductivity(rock.mesh, test::rock_only(), rock.model, window<dim>(5, 6)), InputError);
}

// Both splits of their cells conduct, and both are measured.
TEST(EffectiveConductivity, OfHexahedraAndWedgesIsWhatTheyAreMadeOf) {
  for (const auto cells : {mesh::CellKind::hexahedron, mesh::CellKind::wedge}) {
    mesh::BodySpec body;
    body.name = "box";
    body.shape = mesh::Box{.size = {1, 0.8, 0.6}};
    body.mesh_size = 0.5;
    body.cells = cells;
    body.material = MaterialId{0};
    const auto mesh = mesh::make_blocks<3>({body});
    const HeatModel model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<3>(), test::options_for(mesh, 300));
    const Aabb<3> window(Point<3>(-0.5, -0.4, -0.3), Point<3>(0.5, 0.4, 0.3));
    const auto found = effective_conductivity(mesh, test::rock_only(), model, window);
    const double rock = *test::rock_only()[MaterialId{0}].conductivity->value.constant();
    const Eigen::Matrix3d exact = rock * Eigen::Matrix3d::Identity();
    EXPECT_LT((found.upper - exact).norm(), 1e-12 * rock);
    ASSERT_TRUE(found.lower.has_value());
    EXPECT_LT((*found.lower - exact).norm(), 1e-10 * rock);
    EXPECT_LT((found.along - Point<3>::Constant(rock)).norm(), 1e-10 * rock);
    EXPECT_NEAR(found.solid_fraction, 1, 1e-12);
    EXPECT_NEAR(found.volume_mean, rock, 1e-12 * rock);
  }
}

}  // namespace
}  // namespace scree::thermal
