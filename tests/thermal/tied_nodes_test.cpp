#include "thermal/tied_nodes.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

template <class Dim>
class TiedNodes : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(TiedNodes, Dimensions);

template <int dim>
mesh::BlockMesh<dim> bar_of(bool block_per_element) {
  test::Slab<dim> slab = test::bar<dim>(0.4, 5, 2, 0.1);
  slab.block_per_element = block_per_element;
  return test::slab_mesh<dim>({slab});
}

// Two bars end to end, the second with its own number of cells across.
template <int dim>
mesh::BlockMesh<dim> two_bars(int across) {
  std::vector<test::Slab<dim>> bars{test::bar<dim>(0.2, 3, 2, 0.1), test::bar<dim>(0.2, 4, across, 0.1)};
  bars[1].low[0] = 0.2;
  return test::slab_mesh<dim>(bars);
}

template <int dim>
HeatOptions options_of(const mesh::BlockMesh<dim>& mesh, const JointLaw& law) {
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = law;
  return options;
}

template <int dim>
HeatModel model_of(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options,
                   const Table<MaterialId, Material>& materials = test::rock_only()) {
  return make_heat_model(mesh, materials, contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {})),
                         options);
}

template <int dim>
Eigen::VectorXd after_an_hour(const mesh::BlockMesh<dim>& mesh) {
  HeatOptions options = options_of(mesh, PerfectJoint{});
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 373.15, "left"));
  options.time.until = options.time.output_every = 3600;
  const HeatModel model = model_of(mesh, options);
  HeatRun run(model, options.time);
  run.advance_to(3600);
  return model.rows.to_nodes(run.state().temperature);
}

TYPED_TEST(TiedNodes, MakeBlocksOfMatchingMeshesOneMesh) {
  constexpr int dim = TypeParam::value;
  const auto broken = bar_of<dim>(true), whole = bar_of<dim>(false);
  EXPECT_EQ(model_of(broken, options_of(broken, PerfectJoint{})).capacity.size(),
            static_cast<Eigen::Index>(whole.nodes.size()));
  const Eigen::VectorXd of_broken = after_an_hour(broken), of_whole = after_an_hour(whole);
  for (const ElementId e : whole.elements.ids()) {  // made in one order
    for (int corner = 0; corner <= dim; ++corner) {
      const NodeId here = broken.elements[e][corner], there = whole.elements[e][corner];
      EXPECT_NEAR(of_broken[here.value()], of_whole[there.value()], 1e-9);
    }
  }
}

TYPED_TEST(TiedNodes, KeepTheHeatOfAStartThatIsNotTheSameOnBothSides) {
  constexpr int dim = TypeParam::value;
  auto mesh = two_bars<dim>(2);
  mesh.bodies[BodyId{1}].material = MaterialId{1};
  Table<MaterialId, Material> materials = test::rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].density = 7000;
  double heat[2] = {0, 0};
  Eigen::Index rows[2] = {0, 0};
  for (const bool tied : {false, true}) {
    HeatOptions options = options_of(mesh, tied ? JointLaw(PerfectJoint{}) : JointLaw(JointConductance{10}));
    options.initial_temperature[BodyId{1}] = 400;
    const HeatModel model = model_of(mesh, options, materials);
    heat[tied ? 1 : 0] = model.capacity.dot(model.initial);
    rows[tied ? 1 : 0] = model.capacity.size();
  }
  EXPECT_EQ(rows[0] - rows[1], dim == 2 ? 3 : 9);
  EXPECT_NEAR(heat[1] / heat[0], 1, 1e-14);
}

TYPED_TEST(TiedNodes, AreNoneWhereFacesDoNotMatch) {
  constexpr int dim = TypeParam::value;
  const auto mesh = two_bars<dim>(3);
  EXPECT_TRUE(model_of(mesh, options_of(mesh, PerfectJoint{})).rows.is_identity());
}

TYPED_TEST(TiedNodes, AreNoneWherePropertiesDependOnTemperature) {
  constexpr int dim = TypeParam::value;
  const auto mesh = two_bars<dim>(2);
  Table<MaterialId, Material> materials = test::rock_only();
  materials[MaterialId{0}].specific_heat = Curve::from_table(LinearTable({300, 400}, {800, 900}));
  EXPECT_TRUE(model_of(mesh, options_of(mesh, PerfectJoint{}), materials).rows.is_identity());
}

TYPED_TEST(TiedNodes, AreHeldAsOneWhereOneSideIs) {
  constexpr int dim = TypeParam::value;
  const auto mesh = two_bars<dim>(2);
  HeatOptions options = options_of(mesh, PerfectJoint{});
  options.boundaries.push_back(test::hold(BodyId{0}, 0.2, 373.15, "middle"));
  const HeatModel model = model_of(mesh, options);
  EXPECT_EQ(model.tied_nodes, dim == 2 ? 3U : 9U);
  EXPECT_EQ(model.fixed_nodes.size(), model.tied_nodes);
  for (const NodeId node : mesh.nodes.ids()) {
    const bool held = std::binary_search(model.fixed_nodes.begin(), model.fixed_nodes.end(), model.rows[node]);
    EXPECT_EQ(held, std::abs(mesh.nodes[node].x() - 0.2) < 1e-9);
  }
}

TYPED_TEST(TiedNodes, AreNoneWhereEachSideIsHeldByItsOwnCondition) {
  constexpr int dim = TypeParam::value;
  const auto mesh = two_bars<dim>(2);
  HeatOptions options = options_of(mesh, PerfectJoint{});
  options.boundaries.push_back(test::hold(BodyId{0}, 0.2, 373.15, "end of the first"));
  options.boundaries.push_back(test::hold(BodyId{1}, 0.2, 373.15, "start of the second"));
  EXPECT_EQ(model_of(mesh, options).tied_nodes, 0U);
}

// The third bar has a springy joint with the second and, along a line of nodes, a row of the first's in common with it.
TYPED_TEST(TiedNodes, LeaveKSymmetricWithZeroRowSumsBesideOtherJoints) {
  constexpr int dim = TypeParam::value;
  std::vector<test::Slab<dim>> bars(3, test::bar<dim>(0.2, 2, 2, 0.2));
  bars[1].low[0] = 0.2;
  bars[2].low[1] = 0.2;
  bars[2].size[0] = 0.4;
  bars[2].cells[0] = 4;
  const auto mesh = test::slab_mesh<dim>(bars);
  HeatOptions options = options_of(mesh, PerfectJoint{});
  options.joint.rules.push_back({std::array{BodyId{1}, BodyId{2}}, StiffnessFactor{10}, {}, {}});
  const HeatModel model = model_of(mesh, options);
  const SparseMatrix transposed = model.conductance.transpose();
  EXPECT_EQ((model.conductance - transposed).norm(), 0);
  const double scale = model.conductance.coeffs().abs().maxCoeff();
  EXPECT_LT((model.conductance * Eigen::VectorXd::Ones(model.capacity.size())).cwiseAbs().maxCoeff(), 1e-13 * scale);
  const auto tied = static_cast<Eigen::Index>(mesh.nodes.size()) - model.capacity.size();
  EXPECT_EQ(tied, dim == 2 ? 6 : 18);  // both joints of the first bar
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(model.conductance), Eigen::EigenvaluesOnly);
  EXPECT_NEAR(eigen.eigenvalues()[0], 0, 1e-12 * scale);
  EXPECT_GT(eigen.eigenvalues()[1], 1e-6 * scale);
}

// A field that is linear in each bar: the joint carries its flux.
TYPED_TEST(TiedNodes, PassTheFluxOfTheElementsBesideThem) {
  constexpr int dim = TypeParam::value;
  const auto mesh = two_bars<dim>(2);
  const HeatOptions options = options_of(mesh, PerfectJoint{});
  const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
  Eigen::VectorXd temperature(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) temperature[node.value()] = 400 - 50 * mesh.nodes[node].x();
  double flow = 0;
  for (const double part : contact_flows(contacts, joint_conduction(mesh, test::rock_only(), contacts, options.joint),
                                         temperature, JointForm::consistent)) {
    flow += part;
  }
  EXPECT_NEAR(std::abs(flow), 50 * 4.0 * std::pow(0.1, dim - 1), 1e-10);
}

// What would flow there grows with every refinement of the mesh.
TYPED_TEST(TiedNodes, APerfectJointHeldAtTwoTemperaturesIsRefused) {
  constexpr int dim = TypeParam::value;
  auto right = test::bar<dim>(0.1, 2, 3, 0.1);
  right.low[0] = 0.1;
  for (const int cells : {2, 3}) {  // faces that do not match, and faces that do
    const auto mesh = test::slab_mesh<dim>({test::bar<dim>(0.1, 2, cells, 0.1), right});
    for (const double temperature : {300.0, 400.0}) {
      HeatOptions options = test::options_for(mesh, 300);
      options.joint.law = PerfectJoint{};
      options.boundaries.push_back(test::hold(BodyId{0}, 0.1, 400, "left"));
      options.boundaries.push_back(test::hold(BodyId{1}, 0.1, temperature, "right"));
      const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
      if (temperature == 400) {
        EXPECT_NO_THROW(make_heat_model(mesh, test::rock_only(), contacts, options)) << cells;
      } else {
        EXPECT_THROW(make_heat_model(mesh, test::rock_only(), contacts, options), InputError) << cells;
      }
    }
  }
}

}  // namespace
}  // namespace scree::thermal
