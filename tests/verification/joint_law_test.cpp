// Two bodies and a joint of conductance h: composite slabs and half-spaces against their closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "tests/verification/steady.h"
#include "thermal/heat_run.h"
#include "thermal/joint_report.h"

namespace scree::thermal {
namespace {

JointOptions joint_of(const JointLaw& law, std::optional<contact::Model> model = {}) {
  JointOptions joint;
  joint.law = law;
  joint.model = model;
  return joint;
}

// Two bars end to end along x, meeting at x = 0, `across_right` cells across on the right and two on the left.
// As fine across as along where the order is measured.
mesh::BlockMesh<2> two_bars(double length, int cells, int across_right, MaterialId right_material = MaterialId{0}) {
  auto left = test::bar<2>(length, cells, cells == 20 ? 4 : 2, 0.01);
  left.low[0] = -length;
  auto right = test::bar<2>(length, cells, across_right, 0.01);
  right.material = right_material;
  return test::slab_mesh<2>({left, right});
}

Table<MaterialId, Material> two_materials(double second_conductivity) {
  Table<MaterialId, Material> materials = test::rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = second_conductivity;
  return materials;
}

struct Case {
  mesh::BlockMesh<2> mesh;
  Table<MaterialId, Material> materials;
  JointOptions joint;
  double left = 350, right = 250;  // at the start [K]
};

// Temperatures after `time` of insulated bars that start at two temperatures.
Eigen::VectorXd cooled(const Case& start, double time) {
  const auto contacts = contact::find_contacts(start.mesh, contact_search(start.joint, start.mesh.bodies, {}));
  HeatOptions options = test::options_for(start.mesh, start.left);
  options.initial_temperature[BodyId{1}] = start.right;
  options.joint = start.joint;
  TimeOptions times;
  times.until = time;
  times.tolerance = 0.001;
  HeatRun run(make_heat_model(start.mesh, start.materials, contacts, options), times);
  run.advance_to(time);
  return run.state().temperature;
}

// Mean at the joint, of the left body or of the right.
double at_joint(const Case& of, const Eigen::VectorXd& temperature, BlockId block) {
  double sum = 0;
  int count = 0;
  for (const NodeId node : of.mesh.blocks[block].nodes) {
    if (std::abs(of.mesh.nodes[node].x()) > 1e-9) continue;
    sum += temperature[node.value()];
    ++count;
  }
  return sum / count;
}

// Half of the difference is left cos-shaped in a slab that loses heat at 2 h to the plane of symmetry: zeta tan zeta = 2 h L/k,
// C = 4 sin zeta/(2 zeta + sin 2 zeta) (Carslaw and Jaeger, Conduction of Heat in Solids, 1959, section 3.11).
double slab_series(double biot, double fourier, double place) {
  double sum = 0;
  for (int n = 0; n < 60; ++n) {
    double low = n * M_PI, high = n * M_PI + M_PI / 2;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      const double excess = (n % 2 == 0 ? 1 : -1) * (middle * std::sin(middle) - biot * std::cos(middle));
      (excess > 0 ? high : low) = middle;
    }
    const double zeta = 0.5 * (low + high);
    sum += 4 * std::sin(zeta) / (2 * zeta + std::sin(2 * zeta)) * std::exp(-zeta * zeta * fourier) * std::cos(zeta * place);
  }
  return sum;
}

double largest_slab_error(const JointOptions& joint, int cells, int across_right) {
  constexpr double length = 0.1, h = 40, k = 4, diffusivity = 2e-6;
  const Case start{two_bars(length, cells, across_right), test::rock_only(), joint};
  double largest = 0;
  for (const double time : {500.0, 2000.0, 5000.0}) {
    const Eigen::VectorXd temperature = cooled(start, time);
    for (const NodeId node : start.mesh.nodes.ids()) {
      const double x = start.mesh.nodes[node].x();
      const bool left = start.mesh.blocks[BlockId{0}].nodes.last() > node.index();
      const double series = slab_series(2 * h * length / k, diffusivity * time / length / length, 1 - std::abs(x) / length);
      largest = std::max(largest, std::abs(temperature[node.value()] - 300 - (left ? 50 : -50) * series));
    }
  }
  return largest;
}

TEST(TwoSlabs, ExchangeHeatByTheSeriesOfACompositeSlab) {
  for (const auto model : {contact::Model::overlap, contact::Model::semi_spring}) {
    const double coarse = largest_slab_error(joint_of(JointConductance{40}, model), 10, 2);
    const double fine = largest_slab_error(joint_of(JointConductance{40}, model), 20, 4);
    EXPECT_LT(fine, 0.05);
    EXPECT_GT(coarse / fine, 3) << "second order: " << coarse << " then " << fine;
  }
}

TEST(TwoSlabs, ExchangeTheSameThroughOverlapsOfMeshesThatDoNotMatch) {
  EXPECT_LT(largest_slab_error(joint_of(JointConductance{40}), 20, 3), 0.05);
}

// Steady flow through two slabs of conductivities 4 and 10 with a joint between: 1/(L/k1 + 1/h + L/k2).
double steady_flow(const mesh::BlockMesh<2>& mesh, const JointOptions& joint, std::vector<JointReport>& report) {
  const auto materials = two_materials(10);
  const auto contacts = contact::find_contacts(mesh, contact_search(joint, mesh.bodies, {}));
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint;
  const HeatModel model = make_heat_model(mesh, materials, contacts, options);
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node].x() < -0.1 + 1e-9) held[node] = 400;
    if (mesh.nodes[node].x() > 0.1 - 1e-9) held[node] = 300;
  }
  const Eigen::VectorXd temperature = test::steady(model, held);
  const auto flows = contact_flows(contacts, joint_conduction(mesh, materials, contacts, joint), temperature, joint.form);
  report = joint_reports(mesh, materials, contacts, joint, flows);
  return report.front().flow;
}

TEST(TwoSlabs, AreResistancesInSeriesAndTheReportSaysHowLarge) {
  for (const double h : {1.0, 40.0, 1e4}) {
    const double expected = 100 * 0.01 / (0.1 / 4 + 1 / h + 0.1 / 10);
    std::vector<JointReport> report;
    for (const int across : {2, 3}) {
      const auto mesh = two_bars(0.1, 4, across, MaterialId{1});
      EXPECT_NEAR(steady_flow(mesh, joint_of(JointConductance{h}), report) / expected, 1, 1e-9) << h << " " << across;
      EXPECT_NEAR(report.front().joint_conductance / h, 1, 1e-12);
      EXPECT_NEAR(report.front().touching_area, 0.01, 1e-15);
      // The beta that the report states gives that flow: on each side beta k/dL.
      const auto stiff = joint_of(StiffnessFactor{report.front().stiffness_factor}, contact::Model::overlap);
      EXPECT_NEAR(steady_flow(mesh, stiff, report) / expected, 1, 0.02) << h << " " << across;
      EXPECT_NEAR(report.front().joint_conductance / h, 1, 1e-12);
    }
    const auto by_springs = joint_of(JointConductance{h}, contact::Model::semi_spring);
    EXPECT_NEAR(steady_flow(two_bars(0.1, 4, 2, MaterialId{1}), by_springs, report) / expected, 1, 1e-9) << h;
  }
}

TEST(TwoSlabs, DoNotExchangeHeatThroughAnInsulatingJoint) {
  const Case start{two_bars(0.1, 10, 2), test::rock_only(), joint_of(InsulatingJoint{})};
  const Eigen::VectorXd temperature = cooled(start, 5000);
  EXPECT_NEAR(at_joint(start, temperature, BlockId{0}), 350, 1e-9);
  EXPECT_NEAR(at_joint(start, temperature, BlockId{1}), 250, 1e-9);
}

// Short times: neither bar feels its far end. A surface that loses heat at 2 h to the plane of symmetry is at
// exp(z^2) erfc(z), z = 2 h sqrt(kappa t)/k (Carslaw and Jaeger, section 2.7).
TEST(TwoHalfSpaces, WithAJointFollowTheErrorFunction) {
  for (const auto model : {contact::Model::overlap, contact::Model::semi_spring}) {
    const Case start{two_bars(0.5, 250, 2), test::rock_only(), joint_of(JointConductance{100}, model)};
    for (const double time : {50.0, 1000.0}) {
      const double z = 2 * 100 * std::sqrt(2e-6 * time) / 4;
      const double expected = 50 * std::exp(z * z) * std::erfc(z);
      const Eigen::VectorXd temperature = cooled(start, time);
      EXPECT_NEAR(at_joint(start, temperature, BlockId{0}) - 300, expected, 0.05) << time;
      EXPECT_NEAR(at_joint(start, temperature, BlockId{1}) - 300, -expected, 0.05) << time;
    }
  }
}

// Without a joint the contact is at once at the mean by effusivities sqrt(k rho c), here 1 to 3.
TEST(TwoHalfSpaces, TiedTogetherMeetAtTheMeanByEffusivities) {
  Case start{two_bars(0.5, 250, 3, MaterialId{1}), two_materials(36), joint_of(PerfectJoint{})};
  start.left = 400;
  start.right = 300;
  for (const double time : {50.0, 400.0}) {
    const Eigen::VectorXd temperature = cooled(start, time);
    EXPECT_NEAR(at_joint(start, temperature, BlockId{0}), 325, 0.2) << time;
    EXPECT_NEAR(at_joint(start, temperature, BlockId{1}), 325, 0.2) << time;
  }
}

}  // namespace
}  // namespace scree::thermal
