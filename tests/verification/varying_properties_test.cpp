// Properties that depend on temperature or direction, and the general scheme.
#include <cmath>

#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/temp_folder.h"
#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/bookkeeper.h"
#include "thermal/drive.h"
#include "thermal/fluxes.h"
#include "thermal/heat_run.h"
#include "thermal/joint_conduction.h"
#include "thermal/steady_state.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {
namespace {

Table<MaterialId, Material> varying_rock() {
  Material rock = test::rock();
  rock.conductivity = test::curve("1 + 0.01*T");
  rock.specific_heat = test::curve("400 + T");
  return Table<MaterialId, Material>({rock});
}

// Kirchhoff: Phi = T + 0.005 T^2 is linear between the ends.
TEST(VaryingProperties, ASteadyBarFollowsKirchhoffsTransformToRounding) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 7, 2, 0.3)});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 900, "hot"));
  options.boundaries.push_back(test::hold(BodyId{0}, 1, 300, "cold"));
  const HeatState steady = steady_state(make_heat_model(mesh, varying_rock(), {}, options));
  const auto phi = [](double t) { return t + 0.005 * t * t; };
  for (const NodeId node : mesh.nodes.ids()) {
    const double exact = phi(900) + mesh.nodes[node].x() * (phi(300) - phi(900));
    EXPECT_NEAR(phi(steady.temperature[node.value()]) / exact, 1, 1e-10);
  }
  EXPECT_NEAR(steady.ledger.by_boundary.at(0), 0.09 * (phi(900) - phi(300)), 1e-6);
  EXPECT_LT(steady.ledger.relative_residual(), 1e-11);
  const auto flux = element_fluxes(mesh, varying_rock(), steady.temperature);
  for (const Point<3>& q : flux) EXPECT_LT((q - Point<3>(phi(900) - phi(300), 0, 0)).norm(), 1e-7);
}

// k = 100 (300/T)^2 W/m/K, which is infinite at 0 K: 1/T is linear.
TEST(VaryingProperties, ASteadyConductivityThatGrowsBeyondAllBoundsTowardsZeroKelvinIsExact) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 6, 2, 0.3)});
  HeatOptions options = test::options_for(mesh, 300);  // from where the first iteration would go far below 0 K
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 1300, "hot"));
  options.boundaries.push_back(test::hold(BodyId{0}, 1, 300, "cold"));
  Material rock = test::rock();
  rock.conductivity = test::curve("100*(300/T)^2");
  const HeatModel model = make_heat_model(mesh, Table<MaterialId, Material>({rock}), {}, options);
  const HeatState steady = steady_state(model);
  for (const NodeId node : mesh.nodes.ids()) {
    const double x = mesh.nodes[node].x();
    EXPECT_NEAR(steady.temperature[node.value()], 1 / ((1 - x) / 1300 + x / 300), 1e-6);
  }
  EXPECT_NEAR(steady.ledger.by_boundary.at(0), 0.09 * 9e6 * (1.0 / 300 - 1.0 / 1300), 1e-5);
}

auto four_in_a_row(const test::Slab<3>& bar) {
  std::vector<test::Slab<3>> bars(4, bar);
  for (int i = 0; i < 4; ++i) bars[static_cast<std::size_t>(i)].low[0] = bar.size[0] * i;
  return test::slab_mesh<3>(bars);
}

// The same with joints so stiff that they hardly count, and a conductivity that bends within an element.
TEST(VaryingProperties, AConductivityThatFallsAHundredfoldWithinAKelvinIsSolvedForAcrossStiffJoints) {
  const auto mesh = four_in_a_row(test::bar<3>(0.25, 5, 2, 0.1));
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{1e6};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "hot"));
  options.boundaries.push_back(test::hold(BodyId{3}, 1, 300, "cold"));
  Material rock = test::rock();
  const Curve falling = Curve::from_table(LinearTable({330, 331}, {5, 0.05}));
  rock.conductivity = falling;
  const HeatModel model = make_heat_model(mesh, Table<MaterialId, Material>({rock}), test::matching_contacts(mesh), options);
  for (const LinearSolver solver : {LinearSolver::cholesky, LinearSolver::multigrid}) {
    const HeatState steady = find_steady_state(model, solver).state;
    const double hot = falling.integral(400), cold = falling.integral(300);
    for (const NodeId node : mesh.nodes.ids()) {
      const double exact = hot + mesh.nodes[node].x() * (cold - hot);
      EXPECT_NEAR(falling.integral(steady.temperature[node.value()]), exact, 1e-4 * (hot - cold));
    }
    EXPECT_LT(steady.steps, 40);
    EXPECT_LT(steady.ledger.relative_residual(), 1e-10);
  }
}

HeatModel warming_bar() {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.05, 12, 4, 0.05)});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 330, "hot"));
  return make_heat_model(mesh, varying_rock(), {}, options);
}

// A matrix outlives the outputs, so a state holds what it was made from.
TEST(VaryingProperties, AResumedRunRepeatsTheUninterruptedOneToTheBit) {
  const auto file = scree::test::temp_folder() / "resume.h5";
  const HeatModel model = warming_bar();
  TimeOptions time;
  time.integrator = Integrator::implicit;
  time.until = 200;
  time.output_every = 20;
  HeatRun whole(model, time);
  std::vector<HeatState> states;
  whole.follow([&](const HeatRun::Output& output) {
    if (output.resumable) states.push_back(whole.state());
  });
  EXPECT_GE(states.size(), 5);
  const HeatState& end = states.back();
  EXPECT_LT(end.factorisations, end.steps / 2) << "no matrix serves for several steps";
  for (const HeatState& from : states) {
    write(from, "key", file);
    HeatRun resumed(model, time, read_state(file, "key"));
    resumed.advance_to(200);
    EXPECT_EQ(resumed.state().temperature, end.temperature) << from.time;
    EXPECT_EQ(resumed.state().error, end.error) << from.time;
    EXPECT_EQ(resumed.state().steps, end.steps) << from.time;
  }
}

// One end is warm.
HeatModel warming_row(const Material& rock, double beta) {
  const auto mesh = four_in_a_row(test::bar<3>(0.05, 5, 3, 0.03));
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{beta};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 310, "warm"));
  return make_heat_model(mesh, Table<MaterialId, Material>({rock}), test::matching_contacts(mesh), options);
}

// Where joints are stiff Newton's iteration ends at what rounding leaves of a residual, which no other matrix makes less.
TEST(VaryingProperties, RoundingAtStiffJointsMakesNoNewMatrices) {
  Material rock = test::rock();
  for (const char* varying : {"c", "k"}) {
    rock.specific_heat = *varying == 'c' ? test::curve("500 + T") : Curve(800);
    rock.conductivity = *varying == 'k' ? test::curve("1 + 0.003*T") : Curve(2);
    for (const double beta : {1e3, 1e5, 1e7, 1e9}) {
      const HeatModel model = warming_row(rock, beta);
      Eigen::VectorXd by_cholesky;
      for (const LinearSolver solver : {LinearSolver::cholesky, LinearSolver::multigrid}) {
        const auto scheme = make_implicit_scheme(model, solver);
        Bookkeeper bookkeeper(model, scheme->sums());
        Instant at{0, held(model, model.initial, Drives(model).at(0)), Eigen::VectorXd::Zero(model.initial.size())};
        Ledger ledger = bookkeeper.open(at.temperature);
        constexpr int steps = 20;
        for (; at.time < steps * 60; at.time += 60) {
          const Step step = scheme->step(at, 60);
          ASSERT_GT(step.local.size(), 0) << varying << " " << beta;
          bookkeeper.book(step, at.temperature, 60, ledger);
          at.temperature += step.change;
          at.error = step.error;
        }
        EXPECT_LT(ledger.relative_residual(), 1e-10) << varying << " " << beta;
        if (solver == LinearSolver::cholesky) {
          EXPECT_LE(scheme->factorisations(), 3) << varying << " " << beta;
          by_cholesky = at.temperature;
        } else {
          EXPECT_LT((at.temperature - by_cholesky).lpNorm<Eigen::Infinity>(), 1e-6) << varying << " " << beta;
        }
      }
    }
  }
}

TEST(VaryingProperties, AnInsulatedPairOfBodiesKeepsItsHeat) {
  auto warm = test::bar<2>(0.05, 4, 4, 0.05);
  warm.low[0] = 0.05;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.05, 4, 4, 0.05), warm});
  HeatOptions options = test::options_for(mesh, 300);
  options.initial_temperature[BodyId{1}] = 900;
  const HeatModel model = make_heat_model(mesh, varying_rock(), test::matching_contacts(mesh), options);
  for (const Integrator integrator : {Integrator::implicit, Integrator::stabilised_explicit}) {
    TimeOptions time;
    time.integrator = integrator;
    time.until = 1000;
    time.output_every = 500;
    HeatRun run(model, time);
    run.advance_to(1000);
    const auto enthalpy = [](double t) { return 400 * t + t * t / 2; };
    double before = 0;
    double after = 0;
    for (const NodeId node : mesh.nodes.ids()) {
      before += model.varying->mass[node.value()] * enthalpy(model.initial[node.value()]);
      after += model.varying->mass[node.value()] * enthalpy(run.state().temperature[node.value()]);
    }
    EXPECT_NEAR(after / before, 1, 1e-11);
    EXPECT_TRUE(run.within_tolerance());
    EXPECT_LT(overshoot(model, run.state()).value(), 0.1);
  }
}

// A bar with everything that can change.
HeatModel busy_bar() {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 8, 1, 0.0125)});
  HeatOptions options = test::options_for(mesh, 500);
  Boundary end = test::hold(BodyId{0}, 0, 500, "end that swings");
  end.condition = FixedTemperature{test::formula("500 + 100*sin(0.02*t)")};
  options.boundaries.push_back(end);
  Boundary air = test::hold(BodyId{0}, 0.1, 0, "wind");
  air.condition = Convection{test::formula("50*(1 + cos(0.05*t))"), test::formula("300 + 0.1*t")};
  options.boundaries.push_back(air);
  air.name = "sky";
  air.condition = Radiation{0.9, 250};
  options.boundaries.push_back(air);
  Source source;
  source.region.body = BodyId{0};
  source.power = test::formula("1e5*x*t");
  source.name = "source";
  options.sources.push_back(source);
  return make_heat_model(mesh, varying_rock(), {}, options);
}

Eigen::VectorXd after(const HeatModel& model, TimeScheme& scheme, double until, int count) {
  Instant at;
  at.temperature = held(model, model.initial, Drives(model).at(0));
  at.error = Eigen::VectorXd::Zero(model.initial.size());
  for (int n = 0; n < count; ++n) {
    at.time = n * until / count;
    const Step step = scheme.step(at, until / count);
    at.temperature += step.change;
    at.error = step.error;
  }
  return at.temperature;
}

TEST(GeneralScheme, IsOfSecondOrderWithEverythingThatCanChange) {
  const HeatModel model = busy_bar();
  const auto scheme = make_implicit_scheme(model);
  const Eigen::VectorXd exact = after(model, *scheme, 200, 2048);
  const auto error = [&](int count) { return (after(model, *scheme, 200, count) - exact).lpNorm<Eigen::Infinity>(); };
  EXPECT_NEAR(std::log2(error(32) / error(64)), 2, 0.2);
  EXPECT_NEAR(std::log2(error(64) / error(128)), 2, 0.1);
}

TEST(GeneralScheme, KeepsItsToleranceAndItsLedger) {
  const HeatModel model = busy_bar();
  TimeOptions time;
  time.until = 200;
  time.output_every = 100;
  time.tolerance = 0.1;
  HeatRun coarse(model, time);
  coarse.advance_to(200);
  time.tolerance = 1e-3;
  HeatRun fine(model, time);
  fine.advance_to(200);
  EXPECT_LE((coarse.state().temperature - fine.state().temperature).lpNorm<Eigen::Infinity>(), coarse.state().time_error);
  EXPECT_TRUE(coarse.within_tolerance());
  EXPECT_LT(coarse.state().ledger.relative_residual(), 1e-10);
  EXPECT_LT(fine.state().ledger.relative_residual(), 1e-10);
}

TEST(GeneralScheme, IsTheLinearOneWhereNothingChanges) {
  auto slab = test::bar<2>(0.06, 3, 2, 0.04);
  slab.block_per_element = true;
  const auto mesh = test::slab_mesh<2>({slab});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "hot"));
  const HeatModel model = make_heat_model(mesh, test::rock_only(), test::matching_contacts(mesh), options);
  Instant at;
  at.temperature = held(model, model.initial, Drives(model).at(0));
  at.error = 1e-3 * at.temperature.array().sin();
  for (const NodeId node : model.fixed_nodes) at.error[node.value()] = 0;
  for (const double length : {1e-3, 10.0, 1e6}) {
    const Step linear = make_linear_scheme(model)->step(at, length);
    const Step general = make_enthalpy_scheme(model)->step(at, length);
    EXPECT_LT((linear.change - general.change).lpNorm<Eigen::Infinity>(), 1e-9);
    EXPECT_LT((linear.error - general.error).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

TEST(GeneralScheme, HotBodiesInSuddenContactDoNotRing) {
  auto hot = test::bar<2>(0.05, 3, 2, 0.05);
  hot.low[0] = 0.05;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.05, 3, 2, 0.05), hot});
  HeatOptions options = test::options_for(mesh, 4);
  options.initial_temperature[BodyId{1}] = 2000;
  options.joint.law = StiffnessFactor{1e4};
  const HeatModel model = make_heat_model(mesh, varying_rock(), test::matching_contacts(mesh), options);
  const Instant at{0, model.initial, Eigen::VectorXd::Zero(model.initial.size())};
  const Step step = make_implicit_scheme(model)->step(at, 1e9);
  const Eigen::VectorXd end = model.initial + step.change;
  EXPECT_LT(end.maxCoeff() - end.minCoeff(), 1);  // one step, far above all time scales, ends at one temperature
}

// Two boxes whose meshes do not match at x = 0.1, of materials 0 and `second`.
template <int dim>
mesh::BlockMesh<dim> unlike_boxes(MaterialId second) {
  auto right = test::bar<dim>(0.1, 3, 3, 0.1);
  right.low[0] = 0.1;
  right.material = second;
  return test::slab_mesh<dim>({test::bar<dim>(0.1, 2, 2, 0.1), right});
}

// Held at 900 K and 300 K at its ends.
template <int dim>
struct PerfectPair {
  mesh::BlockMesh<dim> mesh;
  Eigen::VectorXd temperature;  // steady [K]
  double flow = 0;              // into the hot end [W]
  double through_joint = 0;     // by its contacts [W]

  PerfectPair(const Table<MaterialId, Material>& materials, MaterialId second) : mesh(unlike_boxes<dim>(second)) {
    HeatOptions options = test::options_for(mesh, 300);
    options.joint.law = PerfectJoint{};
    options.boundaries.push_back(test::hold(BodyId{0}, 0, 900, "hot"));
    options.boundaries.push_back(test::hold(BodyId{1}, 0.2, 300, "cold"));
    const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
    const HeatState steady = steady_state(make_heat_model(mesh, materials, contacts, options));
    temperature = steady.temperature;
    flow = steady.ledger.by_boundary.at(0);
    const auto joints = joint_conduction(mesh, materials, contacts, options.joint);
    for (const double part : contact_flows(contacts, joints, temperature, options.joint.form)) through_joint += part;
  }
};

template <class Dim>
class PerfectJointOfVaryingRock : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PerfectJointOfVaryingRock, Dimensions);

TYPED_TEST(PerfectJointOfVaryingRock, IsNotThereWhereBothSidesAreOfOneMaterial) {
  constexpr int dim = TypeParam::value;
  const double area = dim == 2 ? 0.1 : 0.01;
  const auto phi = [](double t) { return t + 0.005 * t * t; };
  const PerfectPair<dim> pair(varying_rock(), MaterialId{0});
  for (const NodeId node : pair.mesh.nodes.ids()) {
    const double exact = phi(900) + pair.mesh.nodes[node].x() / 0.2 * (phi(300) - phi(900));
    EXPECT_NEAR(phi(pair.temperature[node.value()]) / exact, 1, 1e-9);
  }
  const double flow = area / 0.2 * (phi(900) - phi(300));
  EXPECT_NEAR(pair.flow / flow, 1, 1e-9);
  EXPECT_NEAR(pair.through_joint / flow, 1, 1e-9);
}

// T is linear in the constant half, Phi in the other; where they meet, at 650 K here, both have the same temperature and flux.
TYPED_TEST(PerfectJointOfVaryingRock, MeetsAConstantMaterialWithoutAJump) {
  constexpr int dim = TypeParam::value;
  const double area = dim == 2 ? 0.1 : 0.01;
  const auto phi = [](double t) { return t + 0.005 * t * t; };
  const double met = 650;
  for (const bool constant_first : {true, false}) {
    Table<MaterialId, Material> materials = varying_rock();
    materials.push_back(test::rock());
    const double ends = constant_first ? phi(met) - phi(300) : phi(900) - phi(met);
    materials[MaterialId{1}].conductivity = ends / (constant_first ? 900 - met : met - 300);
    if (constant_first) std::swap(materials[MaterialId{0}], materials[MaterialId{1}]);
    const PerfectPair<dim> pair(materials, MaterialId{1});
    EXPECT_NEAR(pair.flow / (area / 0.1 * ends), 1, 1e-9);
    EXPECT_NEAR(pair.through_joint / pair.flow, 1, 1e-9);
    for (const NodeId node : pair.mesh.nodes.ids()) {
      if (std::abs(pair.mesh.nodes[node].x() - 0.1) > 1e-9) continue;
      EXPECT_NEAR(pair.temperature[node.value()], met, 1e-6);
    }
  }
}

TYPED_TEST(PerfectJointOfVaryingRock, IsRefusedWhereBothSidesVaryInTheirOwnWays) {
  constexpr int dim = TypeParam::value;
  Table<MaterialId, Material> materials = varying_rock();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = test::curve("3 - 0.001*T");
  EXPECT_THROW(PerfectPair<dim>(materials, MaterialId{1}), InputError);
}

// With k = R diag(3, 1) R^T turned by 30 degrees in the body and 40 more with the block: q = -k grad T.
TEST(Anisotropy, ALinearTemperaturePassesWithTheFluxOfTheTurnedTensor) {
  auto mesh = test::slab_mesh<2>({test::bar<2>(1, 5, 4, 0.6)});
  const auto about_z = [](double degrees) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitZ()));
  };
  mesh.blocks[BlockId{0}].orientation = about_z(40);
  Material rock = test::rock();
  rock.conductivity->value = 2;
  rock.conductivity->ratio = {3, 1, 1};
  rock.conductivity->axes = about_z(30);
  const Table<MaterialId, Material> materials({rock});
  const Eigen::Vector2d gradient(7, -11);
  Eigen::VectorXd temperature(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) temperature[node.value()] = 300 + gradient.dot(mesh.nodes[node]);
  const Eigen::Rotation2Dd turn(70 * M_PI / 180);
  const Eigen::Matrix2d tensor =
      turn.toRotationMatrix() * Eigen::Vector2d(6, 2).asDiagonal() * turn.toRotationMatrix().transpose();
  for (const Point<2>& q : element_fluxes(mesh, materials, temperature)) EXPECT_LT((q + tensor * gradient).norm(), 1e-10);
  const HeatModel model = make_heat_model(mesh, materials, {}, test::options_for(mesh, 300));
  const Eigen::VectorXd heating = model.conductance * temperature;
  for (const NodeId node : mesh.nodes.ids()) {
    const Point<2>& at = mesh.nodes[node];
    const bool inner = at.x() > 0.01 && at.x() < 0.99 && at.y() > 0.01 && at.y() < 0.59;
    EXPECT_LT(inner ? std::abs(heating[node.value()]) : 0, 1e-9);
  }
}

}  // namespace
}  // namespace scree::thermal
