// Lumped blocks against closed forms and against meshed runs of the same scene.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/thermal/lumped_cases.h"
#include "thermal/steady_state.h"

namespace scree::thermal {
namespace {

using test::heated;
using test::row_of_cubes;

constexpr double volumetric_heat = 2500.0 * 800;  // of the tests' rock [J/m3/K]

template <class Dim>
class LumpedRuns : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LumpedRuns, Dimensions);

// Of a cube's face, and of all its faces [m2].
template <int dim>
double face() {
  return std::pow(test::side, dim - 1);
}
template <int dim>
double capacity() {
  return volumetric_heat * std::pow(test::side, dim);
}

// (T1 - T2) = (T1 - T2)_0 exp(-2 g t/C), and their mean stays.
TYPED_TEST(LumpedRuns, TwoBlocksWithAJointFollowTheExactExponential) {
  constexpr int dim = TypeParam::value;
  for (const Integrator integrator : {Integrator::implicit, Integrator::stabilised_explicit, Integrator::explicit_euler}) {
    auto row = row_of_cubes<dim>(2, 2, 40);
    row.options.blocks.model = BlockModel::lumped;
    const double until = capacity<dim>() / (40 * face<dim>());
    const HeatState state = heated(row.model(), until, 1e-3, integrator);
    const double gap = 100 * std::exp(-2.0);
    const double error = integrator == Integrator::explicit_euler ? state.time_error : 1e-3;
    EXPECT_NEAR(state.temperature[0], 350 + gap / 2, error);
    EXPECT_NEAR(state.temperature[1], 350 - gap / 2, error);
    EXPECT_LT(state.ledger.relative_residual(), 1e-12);
  }
}

TYPED_TEST(LumpedRuns, ABlockInConvectionFollowsTheExactExponential) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(1, 3);
  row.options.boundaries.push_back(test::convection(BodyId{0}, 20, 300.0));
  row.options.blocks.model = BlockModel::lumped;
  const double tau = capacity<dim>() / (20 * 2 * dim * face<dim>());
  const HeatState state = heated(row.model(), 1.5 * tau, 1e-3);
  EXPECT_NEAR(state.temperature[0], 300 + 100 * std::exp(-1.5), 1e-3);
  EXPECT_LT(state.ledger.relative_residual(), 1e-12);
}

TYPED_TEST(LumpedRuns, DoNotDependOnTheMesh) {
  constexpr int dim = TypeParam::value;
  std::vector<HeatState> states;
  for (const int cells : {1, 2, 4}) {
    auto row = row_of_cubes<dim>(4, cells);
    row.options.boundaries.push_back(test::convection(BodyId{3}, 20, 300.0));
    row.options.blocks.model = BlockModel::lumped;
    states.push_back(heated(row.model()));
  }
  EXPECT_LT((states[1].temperature - states[0].temperature).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((states[2].temperature - states[0].temperature).lpNorm<Eigen::Infinity>(), 1e-9);
}

TYPED_TEST(LumpedRuns, KeepTheLedgerWithPropertiesThatVaryAndRadiation) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(4, 2, 40);
  row.materials[MaterialId{0}].specific_heat = test::curve("500 + T");
  row.materials[MaterialId{0}].conductivity = Conductivity(test::curve("2 + 0.005*T"));
  Boundary radiation = test::convection(BodyId{3}, 0, 300.0);
  radiation.condition = Radiation{0.9, 500.0};
  row.options.boundaries.push_back(radiation);
  row.options.sources.push_back({test::on(BodyId{1}), 2e4, "source", {}});
  row.options.blocks.of_body = {{BodyId{0}, BlockModel::lumped}, {BodyId{3}, BlockModel::lumped}};
  const HeatState mixed = heated(row.model());
  EXPECT_LT(mixed.ledger.relative_residual(), 1e-12);
  row.options.blocks = {};
  const HeatState meshed = heated(row.model());
  const Eigen::Index last = meshed.temperature.size() - 1;
  EXPECT_NEAR(mixed.temperature[mixed.temperature.size() - 1], meshed.temperature[last], mixed.lumping.largest);
}

// A lumped run beside the meshed one, over the time that the row takes to even out.
struct Compared {
  double error = 0;     // largest at any node and output
  double estimate = 0;  // of the lumped run
};

template <int dim>
Compared compare(test::Row<dim> row, double until) {
  constexpr int outputs = 40;
  TimeOptions times;
  times.until = until;
  times.output_every = until / outputs;
  times.tolerance = 1e-3;
  const BlockOptions lumped_options = row.options.blocks;
  row.options.blocks = {};
  const HeatModel meshed = row.model();
  row.options.blocks = lumped_options;
  const HeatModel model = row.model();
  HeatRun coarse(model, times), fine(meshed, times);
  Compared result;
  for (int i = 1; i <= outputs; ++i) {
    coarse.advance_to(i * times.output_every);
    fine.advance_to(i * times.output_every);
    const Eigen::VectorXd difference = model.rows.to_nodes(coarse.state().temperature) - fine.state().temperature;
    result.error = std::max(result.error, difference.lpNorm<Eigen::Infinity>());
  }
  result.estimate = coarse.state().lumping.largest;
  return result;
}

template <int dim>
double time_of(int count, double conductance) {
  return 0.3 * count * count * capacity<dim>() / (conductance * face<dim>());
}

TYPED_TEST(LumpedRuns, ApproachTheMeshedRunInTheFirstOrderOfTheBiotNumber) {
  constexpr int dim = TypeParam::value;
  std::vector<double> errors;
  for (const double biot : {0.04, 0.02, 0.01}) {
    auto row = row_of_cubes<dim>(4, dim == 2 ? 6 : 4, test::conductance_for_biot(biot));
    row.options.blocks.model = BlockModel::lumped;
    errors.push_back(compare(row, time_of<dim>(4, test::conductance_for_biot(biot))).error);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 1, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 1, 0.1);
}

// The estimate is 1.1 to 3.0 times the true error of these.
constexpr double most_over = 4;

TYPED_TEST(LumpedRuns, EstimateTheirErrorAboveTheTrueOne) {
  constexpr int dim = TypeParam::value;
  for (const int count : {1, 2, 10}) {
    for (const double biot : {0.001, 0.01, 0.1}) {
      for (const bool cooled : {false, true}) {
        if (count == 1 && !cooled) continue;
        const double h = test::conductance_for_biot(biot);
        auto row = row_of_cubes<dim>(count, 3, h);
        if (cooled) row.options.boundaries.push_back(test::convection(BodyId{static_cast<std::size_t>(count - 1)}, h, 250.0));
        row.options.blocks.model = BlockModel::lumped;
        const Compared found = compare(row, time_of<dim>(count, h));
        EXPECT_LE(found.error, found.estimate);
        EXPECT_LE(found.estimate, most_over * found.error);
      }
    }
  }
}

TYPED_TEST(LumpedRuns, EstimateTheErrorOfTheSteadyState) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(6, 3, test::conductance_for_biot(0.02));
  row.options.joint.rules.push_back({std::array{BodyId{3}, BodyId{4}}, JointConductance{4}, std::nullopt, {}});
  row.options.boundaries = {test::convection(BodyId{0}, 5, 400.0), test::convection(BodyId{5}, 9, 300.0)};
  row.options.boundaries[1].name = "cold air";
  const HeatState meshed = steady_state(row.model());
  row.options.blocks.model = BlockModel::lumped;
  const HeatModel model = row.model();
  const HeatState state = steady_state(model);
  const double error = (model.rows.to_nodes(state.temperature) - meshed.temperature).lpNorm<Eigen::Infinity>();
  EXPECT_LE(error, state.lumping.largest);
  EXPECT_LE(state.lumping.largest, most_over * error);
}

TYPED_TEST(LumpedRuns, EstimateTheirErrorBesideMeshedBlocks) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(6, 3, test::conductance_for_biot(0.02));
  Boundary hot = test::hold(BodyId{0}, 0, 450, "hot");
  row.options.boundaries.push_back(hot);
  row.options.blocks.model = BlockModel::automatic;
  row.options.blocks.largest_biot = 1;
  const Compared found = compare(row, time_of<dim>(6, test::conductance_for_biot(0.02)));
  EXPECT_LE(found.error, found.estimate);
  EXPECT_LE(found.estimate, most_over * found.error);
}

}  // namespace
}  // namespace scree::thermal
