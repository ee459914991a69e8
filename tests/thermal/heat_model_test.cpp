#include "thermal/heat_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/block_conduction.h"
#include "thermal/drive.h"
#include "thermal/joint_conduction.h"

namespace scree::thermal {
namespace {

using test::bar;
using test::between_x;
using test::options_for;
using test::rock_only;
using test::slab_mesh;
using testing::HasSubstr;

template <class Dim>
class HeatModels : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(HeatModels, Dimensions);

// Every element its own block.
template <int dim>
mesh::BlockMesh<dim> rubble() {
  auto slab = bar<dim>(1.0, 3, 2, 0.6);
  slab.block_per_element = true;
  return slab_mesh<dim>({slab});
}

template <int dim>
Eigen::VectorXd linear_field(const mesh::BlockMesh<dim>& mesh) {
  Eigen::VectorXd temperature(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids())
    temperature[node.value()] = 300 + 40 * mesh.nodes[node].sum() - 9 * mesh.nodes[node][0];
  return temperature;
}

// The largest heating of a node that lies inside the rubble.
template <int dim>
double inner_heating(const mesh::BlockMesh<dim>& mesh, const Eigen::VectorXd& heating) {
  double largest = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    const Point<dim>& at = mesh.nodes[node];
    const bool inner =
        at[0] > 0.01 && at[0] < 0.99 && (at.array().tail(dim - 1) > 0.01).all() && (at.array().tail(dim - 1) < 0.59).all();
    if (inner) largest = std::max(largest, std::abs(heating[node.value()]));
  }
  return largest;
}

TYPED_TEST(HeatModels, ConductanceIsSymmetricWithZeroRowSums) {
  constexpr int dim = TypeParam::value;
  const auto mesh = rubble<dim>();
  const auto contacts = test::matching_contacts(mesh);
  ASSERT_FALSE(contacts.contacts.empty());
  for (const JointForm form : {JointForm::consistent, JointForm::literal}) {
    HeatOptions options = options_for(mesh, 300);
    options.joint.form = form;
    const HeatModel model = make_heat_model(mesh, rock_only(), contacts, options);
    const SparseMatrix transposed = model.conductance.transpose();
    EXPECT_EQ((model.conductance - transposed).norm(), 0);
    const Eigen::VectorXd sums = model.conductance * Eigen::VectorXd::Ones(model.conductance.cols());
    EXPECT_LT(sums.cwiseAbs().maxCoeff(), 1e-13 * model.conductance.coeffs().abs().maxCoeff());
  }
}

// Summed over the nodes that share a place, a linear field heats nothing: what comes through one block leaves through the next.
TYPED_TEST(HeatModels, ConsistentJointsLetALinearFieldPassAndLiteralOnesDoNot) {
  constexpr int dim = TypeParam::value;
  const auto mesh = rubble<dim>();
  const auto contacts = test::matching_contacts(mesh);
  const Eigen::VectorXd temperature = linear_field(mesh);
  for (const double beta : {0.1, 1e3}) {
    for (const JointForm form : {JointForm::consistent, JointForm::literal}) {
      JointOptions joint;
      joint.law = StiffnessFactor{beta};
      joint.form = form;
      const auto joints = joint_conduction(mesh, rock_only(), contacts, joint);
      double largest = 0;
      for (const double flow : contact_flows(contacts, joints, temperature, form)) largest = std::max(largest, std::abs(flow));
      if (form == JointForm::consistent) {
        EXPECT_LT(largest, 1e-12 * beta * 4.0 * 40);
      } else {
        EXPECT_GT(largest, 1e-3 * beta * 4.0 * 40);
      }
    }
  }
}

TYPED_TEST(HeatModels, ALinearFieldHeatsNoInnerNodeOfABlock) {
  constexpr int dim = TypeParam::value;
  const auto mesh = slab_mesh<dim>({bar<dim>(1.0, 5, 4, 0.6)});
  const HeatModel model = make_heat_model(mesh, rock_only(), {}, options_for(mesh, 300));
  EXPECT_LT(inner_heating<dim>(mesh, model.conductance * linear_field(mesh)), 1e-10);
}

TYPED_TEST(HeatModels, FlowsOfContactsAreWhatTheyAddToTheBalance) {
  constexpr int dim = TypeParam::value;
  const auto mesh = rubble<dim>();
  const auto contacts = test::matching_contacts(mesh);
  HeatOptions options = options_for(mesh, 300);
  const HeatModel with = make_heat_model(mesh, rock_only(), contacts, options);
  const HeatModel without = make_heat_model(mesh, rock_only(), {}, options);
  Eigen::VectorXd temperature(with.initial.size());
  for (Eigen::Index i = 0; i < temperature.size(); ++i) temperature[i] = 300 + 10 * std::sin(3.0 * static_cast<double>(i));
  const Eigen::VectorXd lost = (with.conductance - without.conductance) * temperature;
  std::vector<double> by_block(mesh.blocks.size(), 0);
  const auto flows =
      contact_flows(contacts, joint_conduction(mesh, rock_only(), contacts, options.joint), temperature, JointForm::consistent);
  for (std::size_t c = 0; c < flows.size(); ++c) {
    by_block[contacts.contacts[c].owner.index()] += flows[c];
    by_block[contacts.contacts[c].target.index()] -= flows[c];
  }
  for (const BlockId block : mesh.blocks.ids()) {
    double sum = 0;
    for (const NodeId node : mesh.blocks[block].nodes) sum += lost[node.value()];
    EXPECT_NEAR(sum, by_block[block.index()], 1e-9);
  }
}

TYPED_TEST(HeatModels, ConductanceOfAContactIsEquationEleven) {
  constexpr int dim = TypeParam::value;
  auto right = bar<dim>(1.0, 2, 1, 0.5);
  right.low[0] = 1.0;
  right.material = MaterialId{1};
  const auto mesh = slab_mesh<dim>({bar<dim>(1.0, 2, 1, 0.5), right});
  Table<MaterialId, Material> materials = rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = 10;
  const auto contacts = test::matching_contacts(mesh);
  JointOptions joint;
  joint.law = StiffnessFactor{25};
  const auto conductances = joint_conduction(mesh, materials, contacts, joint).conductances;
  ASSERT_FALSE(conductances.empty());
  for (std::size_t c = 0; c < conductances.size(); ++c) {
    const auto& contact = contacts.contacts[c];
    EXPECT_NEAR(conductances[c], 25 * 7.0 / contact.length * contact.area, 1e-12);
  }
}

TYPED_TEST(HeatModels, BoundaryHeatAddsUpToWhatWasAsked) {
  constexpr int dim = TypeParam::value;
  const auto mesh = slab_mesh<dim>({bar<dim>(2.0, 4, 3, 0.5)});
  const double side = dim == 2 ? 0.5 : 0.25;
  HeatOptions options = options_for(mesh, 300);
  options.boundaries.push_back({test::on(BodyId{0}, between_x(0, 0)), HeatFlux{120}, "flux", {}});
  options.boundaries.push_back({test::on(BodyId{0}, between_x(2, 2)), HeatFlow{-7}, "flow", {}});
  options.sources.push_back({test::on(BodyId{0}, between_x(0, 1)), 1000, "source", {}});
  const HeatModel model = make_heat_model(mesh, rock_only(), {}, options);
  Drives drives(model);
  const Drive& drive = drives.at(0);
  ASSERT_EQ(drive.by_load.size(), 3U);
  EXPECT_NEAR(drive.by_load[0], 120 * side, 1e-10);
  EXPECT_NEAR(drive.by_load[1], -7, 1e-12);
  EXPECT_NEAR(drive.by_load[2], 1000 * side, 1e-9);
  EXPECT_NEAR(drive.load.sum(), 120 * side - 7 + 1000 * side, 1e-9);
  for (const NodeId node : mesh.nodes.ids()) {
    const bool between = mesh.nodes[node][0] > 1.01 && mesh.nodes[node][0] < 1.99;
    EXPECT_EQ(between ? drive.load[node.value()] : 0, 0);
  }
}

TYPED_TEST(HeatModels, FixedTemperaturesHoldTheNodesInTheirRegionOnly) {
  constexpr int dim = TypeParam::value;
  auto right = bar<dim>(1.0, 2, 1, 0.5);
  right.low[0] = 1.0;
  const auto mesh = slab_mesh<dim>({bar<dim>(1.0, 2, 1, 0.5), right});
  HeatOptions options = options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{1}, 1.0, 400, "left end of the right slab"));
  options.boundaries.push_back({test::on(BodyId{0}, std::nullopt), FixedTemperature{350}, "all of the left slab", {}});
  const HeatModel model = make_heat_model(mesh, rock_only(), {}, options);
  EXPECT_EQ(model.fixed_nodes.size(), mesh.blocks[BlockId{0}].nodes.size() + (dim == 2 ? 2 : 4));
  Drives drives(model);
  EXPECT_TRUE(std::is_sorted(model.fixed_nodes.begin(), model.fixed_nodes.end()));
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    const bool left = model.blocks[model.fixed_nodes[i]] == BlockId{0};
    EXPECT_EQ(drives.at(0).fixed[static_cast<Eigen::Index>(i)], left ? 350 : 400);
    EXPECT_EQ(model.holds[model.fixed_hold[i]].name, left ? "all of the left slab" : "left end of the right slab");
  }
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(HeatModelErrors, ARegionThatHoldsNothingSaysWhereTheBodyIs) {
  const auto mesh = slab_mesh<2>({bar<2>(2.0, 4, 3, 0.5)});
  HeatOptions options = options_for(mesh, 300);
  options.boundaries.push_back({test::on(BodyId{0}, between_x(3, 4)), FixedTemperature{400}, "warm", {"a.yaml", 7, 3}});
  options.boundaries.push_back({test::on(BodyId{0}, between_x(0.1, 0.4)), HeatFlux{1}, "flux", {}});
  options.sources.push_back({test::on(BodyId{0}, between_x(-2, -1)), 1, "source", {}});
  const std::string message = message_of([&] { make_heat_model(mesh, rock_only(), {}, options); });
  EXPECT_THAT(message,
              HasSubstr("a.yaml:7:3: heat.boundaries: warm is body body0 within (3, -1e+09) to (4, 1e+09) m (must hold at "
                        "least one node). The body reaches from (0, 0) to (2, 0.5) m"));
  EXPECT_THAT(message, HasSubstr("heat.boundaries: flux"));
  EXPECT_THAT(message, HasSubstr("heat.sources: source"));
}

// The first side of every cell in x on "left", whatever the mesh is made of.
template <int dim>
mesh::BlockMesh<dim> named_bar() {
  auto mesh = slab_mesh<dim>({bar<dim>(2.0, 4, 2, 0.5)});
  const SurfaceId left = mesh.surface_names.push_back({BodyId{0}, "left"});
  mesh.surface_names.push_back({BodyId{0}, "right"});
  for (const auto& face : mesh::boundary_faces(mesh)) {
    const bool on_it = std::all_of(face.nodes.begin(), face.nodes.end(), [&](NodeId n) { return mesh.nodes[n][0] == 0; });
    auto nodes = face.nodes;
    std::sort(nodes.begin(), nodes.end());
    if (on_it) mesh.surfaces.push_back({nodes, left});
  }
  std::sort(mesh.surfaces.begin(), mesh.surfaces.end());
  return mesh;
}

TYPED_TEST(HeatModels, ASurfaceTakesTheHeatOfTheRegionThatHoldsItsFaces) {
  constexpr int dim = TypeParam::value;
  const auto mesh = named_bar<dim>();
  HeatOptions by_surface = options_for(mesh, 300), by_region = options_for(mesh, 300);
  for (HeatOptions* options : {&by_surface, &by_region}) {
    options->boundaries.push_back({test::on(BodyId{0}, between_x(0, 0)), HeatFlux{12}, "flux", {}});
    options->boundaries.push_back({test::on(BodyId{0}, between_x(0, 0)), HeatFlow{-5}, "flow", {}});
    options->boundaries.push_back({test::on(BodyId{0}, between_x(0, 0)), FixedTemperature{400}, "held", {}});
  }
  for (Boundary& boundary : by_surface.boundaries) {
    boundary.region.within.reset();
    boundary.region.surface = "left";
  }
  const HeatModel a = make_heat_model(mesh, rock_only(), {}, by_surface), b = make_heat_model(mesh, rock_only(), {}, by_region);
  Drives of_a(a);
  Drives of_b(b);
  EXPECT_EQ(of_a.at(0).load, of_b.at(0).load);
  EXPECT_EQ(a.fixed_nodes, b.fixed_nodes);
  EXPECT_EQ(of_a.at(0).by_load, of_b.at(0).by_load);
  EXPECT_NEAR(of_a.at(0).load.sum(), 12 * (dim == 2 ? 0.5 : 0.25) - 5, 1e-12);
}

TYPED_TEST(HeatModels, OfASurfaceAndARegionBothMustHold) {
  constexpr int dim = TypeParam::value;
  const auto mesh = named_bar<dim>();
  HeatOptions options = options_for(mesh, 300);
  const Aabb<3> lower(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(3, 0.25, 1));
  options.boundaries.push_back({test::on(BodyId{0}, lower, "left"), HeatFlux{1}, "flux", {}});
  options.boundaries.push_back({test::on(BodyId{0}, lower, "left"), FixedTemperature{400}, "held", {}});
  const HeatModel model = make_heat_model(mesh, rock_only(), {}, options);
  EXPECT_NEAR(Drives(model).at(0).load.sum(), dim == 2 ? 0.25 : 0.125, 1e-13);
  EXPECT_EQ(model.fixed_nodes.size(), dim == 2 ? 2u : 6u);
}

// The sum and the first moment along an axis of what the first load puts on the nodes.
template <int dim>
std::pair<double, double> moments(const mesh::BlockMesh<dim>& mesh, const HeatModel& model, int axis) {
  const Eigen::VectorXd load = Drives(model).at(0).load;
  double moment = 0;
  for (const NodeId node : mesh.nodes.ids()) moment += load[node.value()] * mesh.nodes[node][axis];
  return {load.sum(), moment};
}

TYPED_TEST(HeatModels, WhatABoxCutsOutOfASurfaceIsHeatedWhateverTheMesh) {
  constexpr int dim = TypeParam::value;
  const auto mesh = named_bar<dim>();
  HeatOptions options = options_for(mesh, 300);
  const Aabb<3> lower(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(3, 0.3, 1));
  options.boundaries.push_back({test::on(BodyId{0}, lower, "left"), HeatFlux{1}, "flux", {}});
  const auto [heat, moment] = moments(mesh, make_heat_model(mesh, rock_only(), {}, options), 1);
  EXPECT_NEAR(heat, 0.3 * (dim == 2 ? 1 : 0.5), 1e-14);
  EXPECT_NEAR(moment / heat, 0.15, 1e-14);
}

TYPED_TEST(HeatModels, ASourceHeatsWhatItsBoxCutsOutOfTheElements) {
  constexpr int dim = TypeParam::value;
  const auto mesh = slab_mesh<dim>({bar<dim>(2.0, 4, 3, 0.5)});
  HeatOptions options = options_for(mesh, 300);
  options.sources.push_back({test::on(BodyId{0}, between_x(0.31, 1.09)), 1000, "source", {}});
  const auto [heat, moment] = moments(mesh, make_heat_model(mesh, rock_only(), {}, options), 0);
  EXPECT_NEAR(heat, 1000 * 0.78 * (dim == 2 ? 0.5 : 0.25), 1e-9);
  EXPECT_NEAR(moment / heat, 0.7, 1e-12);
}

TEST(HeatModelErrors, AnUnknownSurfaceIsAnsweredWithThoseThatThereAre) {
  const auto mesh = named_bar<3>();
  HeatOptions options = options_for(mesh, 300);
  options.boundaries.push_back({test::on(BodyId{0}, std::nullopt, "top"), HeatFlux{1}, "flux", {"a.yaml", 7, 3}});
  options.boundaries.push_back({test::on(BodyId{0}, std::nullopt, "right"), FixedTemperature{1}, "held", {}});
  options.boundaries.push_back({test::on(BodyId{0}, std::nullopt, "lefft"), HeatFlux{1}, "misspelt", {}});
  const std::string message = message_of([&] { make_heat_model(mesh, rock_only(), {}, options); });
  EXPECT_THAT(message, HasSubstr("a.yaml:7:3: heat.boundaries: flux: surface is top (must be a surface of body body0). Body "
                                 "body0 has left, right"));
  EXPECT_THAT(message, HasSubstr("misspelt: surface is lefft (must be a surface of body body0). Did you mean left? Body body0 "
                                 "has left, right"));
  EXPECT_THAT(message, HasSubstr("heat.boundaries: held is body body0 on right (must hold at least one node)"));
}

TEST(HeatModelErrors, TwoTemperaturesForOneNodeAreRefused) {
  const auto mesh = slab_mesh<2>({bar<2>(2.0, 4, 3, 0.5)});
  HeatOptions options = options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "left"));
  options.boundaries.push_back({test::on(BodyId{0}, between_x(0, 1)), FixedTemperature{300}, "half", {}});
  const std::string message = message_of([&] { make_heat_model(mesh, rock_only(), {}, options); });
  EXPECT_THAT(message, HasSubstr("heat.boundaries: half is 300 K (\"left\" holds the node at (0, 0) m at 400 K)"));
}

TEST(HeatModelErrors, WhatAMaterialLacksIsNamedAllAtOnce) {
  const auto mesh = slab_mesh<2>({bar<2>(2.0, 4, 3, 0.5)});
  Table<MaterialId, Material> materials = rock_only();
  materials[MaterialId{0}].density.reset();
  materials[MaterialId{0}].conductivity = -2;
  const std::string message = message_of([&] { make_heat_model(mesh, materials, {}, HeatOptions{}); });
  EXPECT_THAT(message, HasSubstr("materials.rock.density is missing (must be positive, kg/m3)"));
  EXPECT_THAT(message, HasSubstr("materials.rock.conductivity is -2 (must be positive, W/m/K)"));
  EXPECT_THAT(message, HasSubstr("heat.initial is missing for body body0"));
}

}  // namespace
}  // namespace scree::thermal
