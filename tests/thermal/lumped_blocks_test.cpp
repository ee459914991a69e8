// What lumping does to a model: the projection, the choice, and what is refused.
#include "thermal/lumped_blocks.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/thermal/lumped_cases.h"
#include "thermal/drive.h"
#include "thermal/steady_state.h"

namespace scree::thermal {
namespace {

using test::row_of_cubes;
using testing::HasSubstr;

template <class Dim>
class LumpedBlocksIn : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LumpedBlocksIn, Dimensions);

// P: a column per row of the lumped model.
Eigen::MatrixXd projection(const HeatModel& model, Eigen::Index nodes) {
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(nodes, model.capacity.size());
  for (Eigen::Index node = 0; node < nodes; ++node) p(node, model.rows[NodeId(static_cast<std::size_t>(node))].value()) = 1;
  return p;
}

TYPED_TEST(LumpedBlocksIn, AreTheProjectionOfTheMeshedModel) {
  constexpr int dim = TypeParam::value;
  for (const JointForm form : {JointForm::consistent, JointForm::literal}) {
    auto row = row_of_cubes<dim>(4, 2);
    row.options.joint.form = form;
    row.options.boundaries.push_back(test::convection(BodyId{1}, 5, test::formula("300 + 20*x + 3*y")));
    row.options.sources.push_back({test::on(BodyId{2}), test::formula("1000*(x + y)"), "source", {}});
    const HeatModel meshed = row.model();
    row.options.blocks.of_body = {{BodyId{1}, BlockModel::lumped}, {BodyId{2}, BlockModel::lumped}};
    const HeatModel model = row.model();
    const Eigen::MatrixXd p = projection(model, meshed.capacity.size());
    const Eigen::MatrixXd conductance = p.transpose() * Eigen::MatrixXd(meshed.conductance) * p;
    EXPECT_LT((Eigen::MatrixXd(model.conductance) - conductance).norm(), 1e-13 * conductance.norm());
    EXPECT_LT((model.capacity - p.transpose() * meshed.capacity).norm(), 1e-13 * meshed.capacity.norm());
    const Eigen::VectorXd warm = Eigen::VectorXd::LinSpaced(model.capacity.size(), 300, 400);
    Drives drives(model), meshed_drives(meshed);
    const Eigen::VectorXd heating = HeatBalance(model).heating(warm, drives.at(0));
    const Eigen::VectorXd expected = p.transpose() * HeatBalance(meshed).heating(p * warm, meshed_drives.at(0));
    EXPECT_LT((heating - expected).norm(), 1e-11 * expected.norm());
    const SparseMatrix transposed = model.conductance.transpose();
    EXPECT_EQ((model.conductance - transposed).norm(), 0);
  }
}

TYPED_TEST(LumpedBlocksIn, HaveOneRowEachAndNoEntriesOfTheirInside) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(5, 4);
  row.options.blocks.model = BlockModel::lumped;
  const HeatModel model = row.model();
  EXPECT_EQ(model.capacity.size(), 5);
  EXPECT_EQ(model.conductance.nonZeros(), 5 + 2 * 4);
  EXPECT_EQ(model.lumped->all().size(), 5u);
  EXPECT_EQ(model.rows.to_nodes(model.initial).size(), static_cast<Eigen::Index>(row.mesh.nodes.size()));
}

TYPED_TEST(LumpedBlocksIn, StartAtTheMeanOfTheirTemperaturesAndSayHowFarTheyWereFromIt) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(1, 4);
  row.options.initial_temperature = Table<BodyId, Function>(1, test::formula("300 + 100*x"));
  row.options.blocks.model = BlockModel::lumped;
  const HeatModel model = row.model();
  EXPECT_NEAR(model.initial[0], 300 + 50 * test::side, 1e-9);
  EXPECT_NEAR(model.lumped->all()[0].start_spread, 50 * test::side, 1e-9);
  row.options.initial_temperature = Table<BodyId, Function>(1, 0.1 + 0.2);
  EXPECT_EQ(row.model().initial[0], 0.1 + 0.2);
  EXPECT_EQ(row.model().lumped->all()[0].start_spread, 0);
}

TYPED_TEST(LumpedBlocksIn, AreChosenByTheirBiotNumber) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(3, 2, test::conductance_for_biot(0.001));
  row.options.boundaries.push_back(test::convection(BodyId{2}, test::conductance_for_biot(1), 300.0));
  row.options.blocks.model = BlockModel::automatic;
  row.options.blocks.largest_biot = 0.02;
  const HeatModel model = row.model();
  ASSERT_TRUE(model.lumped);
  EXPECT_TRUE(model.lumped->contain(BlockId{0}));
  EXPECT_TRUE(model.lumped->contain(BlockId{1}));
  EXPECT_FALSE(model.lumped->contain(BlockId{2}));
  // Heated evenly at one end a block of length L has a place at L/3k from its mean; semi-springs sit in the corners.
  const LumpedBlock& end = model.lumped->all()[0];
  ASSERT_EQ(end.patches.size(), 1u);
  EXPECT_EQ(end.patches[0].number, 1u);
  const PatchResistance& resists = end.patches[0].resists;
  const double area = std::pow(test::side, dim - 1);
  EXPECT_GE(resists.bulk, test::side / (3 * 4.0 * area));
  EXPECT_LE(resists.bulk, 1.2 * test::side / (3 * 4.0 * area));
  const double joint = test::conductance_for_biot(0.001) * area;
  EXPECT_NEAR(end.biot, joint * (resists.bulk + resists.constriction), 1e-12);
}

TYPED_TEST(LumpedBlocksIn, WithALimitOfZeroAreNone) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(3, 2);
  const HeatModel meshed = row.model();
  row.options.blocks.model = BlockModel::automatic;
  row.options.blocks.largest_biot = 0;
  const HeatModel model = row.model();
  EXPECT_FALSE(model.lumped);
  EXPECT_EQ((model.conductance - meshed.conductance).norm(), 0);
  const HeatState a = test::heated(meshed), b = test::heated(model);
  EXPECT_EQ(a.temperature, b.temperature);
  EXPECT_EQ(a.steps, b.steps);
}

TYPED_TEST(LumpedBlocksIn, AreHeldAsAWholeOrRefused) {
  constexpr int dim = TypeParam::value;
  auto row = row_of_cubes<dim>(2, 2);
  row.options.blocks.model = BlockModel::lumped;
  Boundary whole = test::hold(BodyId{0}, 0, 350, "hot");
  whole.region.within.reset();
  row.options.boundaries = {whole};
  const HeatModel model = row.model();
  EXPECT_EQ(model.fixed_nodes, std::vector<NodeId>{NodeId{0}});
  EXPECT_LT(test::heated(model).ledger.relative_residual(), 1e-12);

  row.options.boundaries = {test::hold(BodyId{0}, 0, 350, "hot")};
  row.options.boundaries[0].where = {"s.yaml", 7, 5};
  try {
    static_cast<void>(row.model());
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.yaml:7:5: heat.blocks is a lumped block of body0, of which \"hot\" holds"));
    EXPECT_THAT(error.what(), HasSubstr("Give it `meshed` in heat.blocks.bodies"));
  }
  row.options.blocks.model = BlockModel::automatic;
  row.options.blocks.largest_biot = 1e9;
  const HeatModel mixed = row.model();
  EXPECT_FALSE(mixed.lumped->contain(BlockId{0}));
  EXPECT_TRUE(mixed.lumped->contain(BlockId{1}));
}

TEST(LumpedBlocks, WithPerfectJointsAreRefusedOrMeshed) {
  auto row = row_of_cubes<2>(3, 2);
  row.options.joint.rules.push_back({std::array{BodyId{0}, BodyId{1}}, PerfectJoint{}, std::nullopt, {}});
  contact::ContactOptions search;
  row.contacts = contact::find_contacts(row.mesh, contact_search(row.options.joint, row.mesh.bodies, search));
  row.options.blocks.model = BlockModel::automatic;
  row.options.blocks.largest_biot = 1e9;
  const HeatModel mixed = row.model();
  EXPECT_FALSE(mixed.lumped->contain(BlockId{0}));
  EXPECT_FALSE(mixed.lumped->contain(BlockId{1}));
  EXPECT_TRUE(mixed.lumped->contain(BlockId{2}));
  EXPECT_LT(test::heated(mixed).ledger.relative_residual(), 1e-12);
  row.options.blocks.model = BlockModel::lumped;
  row.options.blocks.where = {"s.yaml", 3, 4};
  try {
    static_cast<void>(row.model());
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.yaml:3:4: heat.blocks is a lumped block of body0 with a perfect joint"));
    EXPECT_THAT(error.what(), HasSubstr("body1 with a perfect joint"));
  }
}

TEST(LumpedBlocks, ResumeToTheBitWithTheirErrorEstimate) {
  auto row = row_of_cubes<2>(4, 2);
  row.options.blocks.model = BlockModel::lumped;
  const HeatModel model = row.model();
  TimeOptions options;
  options.until = 3600;
  options.output_every = 600;
  HeatRun whole(model, options);
  whole.advance_to(1800);
  HeatRun second(model, options, whole.state());
  whole.advance_to(3600);
  second.advance_to(3600);
  EXPECT_GT(whole.state().lumping.largest, 0);
  EXPECT_EQ(second.state().temperature, whole.state().temperature);
  EXPECT_EQ(second.state().lumping.carried, whole.state().lumping.carried);
  EXPECT_EQ(second.state().lumping.largest, whole.state().lumping.largest);
}

double largest_difference(const Eigen::VectorXd& temperature, double from) {
  return (temperature.array() - from).abs().maxCoeff();
}

// q L/(2 k) at either end.
TEST(LumpedBlocks, KnowTheirErrorWhereHeatComesInAtOneEndAndLeavesAtTheOther) {
  auto row = row_of_cubes<2>(1, 4);
  for (const double flux : {1000.0, -1000.0}) {
    Boundary boundary;
    boundary.region = test::on(BodyId{0}, test::between_x(flux > 0 ? 0 : test::side, flux > 0 ? 0 : test::side));
    boundary.condition = HeatFlux{flux};
    boundary.name = flux > 0 ? "in" : "out";
    row.options.boundaries.push_back(boundary);
  }
  const double real = largest_difference(test::heated(row.model(), 36000).temperature, 400);
  EXPECT_GT(real, 10);
  row.options.blocks.model = BlockModel::lumped;
  const double stated = test::heated(row.model(), 36000).lumping.largest;
  EXPECT_GT(stated, real);
  EXPECT_LT(stated, 4 * real);
}

// A speck leans on a block of its own temperature. What its small joint resists is nothing to what passes through the large
// one.
TEST(LumpedBlocks, KnowTheSameErrorWhereASpeckOfTheirTemperatureTouchesThem) {
  const auto stated = [](double speck) {
    std::vector<test::Slab<3>> slabs{test::bar<3>(test::side, 2, 2, test::side), test::bar<3>(test::side, 2, 2, test::side)};
    slabs[1].low[0] = test::side;
    if (speck > 0) {
      slabs.push_back(test::bar<3>(speck, 1, 1, speck));
      slabs[2].low = {-speck, 0.4 * test::side, 0.4 * test::side};
    }
    const auto mesh = test::slab_mesh<3>(slabs);
    HeatOptions options = test::options_for(mesh, 400);
    options.initial_temperature[BodyId{1}] = 300.0;
    options.joint.law = JointConductance{test::conductance_for_biot(0.01)};
    options.blocks.model = BlockModel::lumped;
    const auto contacts = contact::find_contacts(mesh, {.model = contact::Model::overlap});
    const HeatModel model = make_heat_model(mesh, test::rock_only(), contacts, options);
    EXPECT_EQ(model.conductance.nonZeros(), speck > 0 ? 7 : 4);
    return test::heated(model).lumping.largest;
  };
  const double alone = stated(0);
  for (const double speck : {0.02 * test::side, 0.001 * test::side}) EXPECT_NEAR(stated(speck) / alone, 1, 0.01);
}

// A window of the surface loses heat to what is hardly colder, the opposite side to cold air.
TEST(LumpedBlocks, KnowTheSameErrorWhereASmallWindowOfThemLosesHardlyAnything) {
  const auto stated = [](bool window) {
    auto row = row_of_cubes<3>(1, 10);
    const auto cooled = [&](const Aabb<3>& within, double surroundings, const char* name) {
      row.options.boundaries.push_back(test::convection(BodyId{0}, 40, surroundings));
      row.options.boundaries.back().region.within = within;
      row.options.boundaries.back().name = name;
    };
    cooled(test::between_x(test::side, test::side), 300, "air");
    const double low = 0.4 * test::side, high = 0.5 * test::side, end = 1e-9 * test::side;
    if (window)
      cooled({Eigen::Vector3d(-end, low - end, low - end), Eigen::Vector3d(end, high + end, high + end)}, 399, "window");
    row.options.blocks.model = BlockModel::lumped;
    return test::heated(row.model()).lumping.largest;
  };
  EXPECT_NEAR(stated(true) / stated(false), 1, 0.001);
}

// Written as a formula of the place, the same coefficient makes an entry of each node of the spot that it cools.
TEST(LumpedBlocks, KnowTheSameErrorWhereACoefficientIsAFormulaOfThePlace) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m2/K", quantity::heat_transfer));
  const auto stated = [&](const Function& coefficient) {
    auto row = row_of_cubes<3>(1, 10);
    Boundary spot = test::convection(BodyId{0}, 0, 300);
    std::get<Convection>(spot.condition).coefficient = coefficient;
    spot.region.within = Aabb<3>{Eigen::Vector3d(-1e-9, -1e-9, -1e-9), Eigen::Vector3d(1e-9, 0.0201, 0.0201)};
    row.options.boundaries.push_back(spot);
    row.options.blocks.model = BlockModel::lumped;
    return test::heated(row.model()).lumping.largest;
  };
  const double constant = stated(40);
  EXPECT_GT(constant, 1);
  EXPECT_NEAR(stated(Function::from_expression("40 + 0*x", unit, ValueRule{})) / constant, 1, 1e-9);
}

// From 50,000 rows on a neighbour's rows do not follow each other (row_order.h).
TEST(LumpedBlocks, KnowTheSameErrorHoweverRowsAreNumbered) {
  const auto stated = [](int cells) {
    const test::Slab<2> low{{0, 0}, {3, 0.4}, {cells, 40}}, middle{{1, 0.4}, {1, 0.6}, {40, 24}},
        high{{0, 1}, {3, 0.4}, {cells, 40}};
    const auto mesh = test::slab_mesh<2>({low, middle, high});
    HeatOptions options = test::options_for(mesh, 300);
    for (const auto& [body, y, temperature] : {std::tuple{0, 0.0, 400.0}, {2, 1.4, 300.0}}) {
      Boundary held = test::hold(BodyId{static_cast<std::size_t>(body)}, 0, temperature, "held");
      held.region.within = Aabb<3>{Eigen::Vector3d(-1, y, -1), Eigen::Vector3d(4, y, 1)};
      options.boundaries.push_back(held);
    }
    options.joint.law = JointConductance{20};
    options.blocks.of_body[BodyId{1}] = BlockModel::lumped;
    const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
    const HeatModel model = make_heat_model(mesh, test::rock_only(), contacts, options);
    return std::pair{model.capacity.size(), find_steady_state(model, LinearSolver::automatic).state.lumping.largest};
  };
  const auto few = stated(590), many = stated(630);
  EXPECT_LT(few.first, 50000);
  EXPECT_GT(many.first, 50000);
  EXPECT_NEAR(many.second / few.second, 1, 0.01);
}

TEST(LumpedBlocks, KnowTheirErrorWhereConvectionBeginsLater) {
  auto row = row_of_cubes<2>(1, 4);
  const auto unit = std::get<UnitConverter>(unit_converter("W/m2/K", quantity::heat_transfer));
  Boundary air = test::convection(BodyId{0}, 0, 300.0);
  std::get<Convection>(air.condition).coefficient = Function::from_expression("t/36", unit, ValueRule{});
  row.options.boundaries.push_back(air);
  const auto meshed = test::heated(row.model());
  const double real = 0.5 * (meshed.temperature.maxCoeff() - meshed.temperature.minCoeff());
  row.options.blocks.model = BlockModel::lumped;
  EXPECT_GT(test::heated(row.model()).lumping.largest, real);
}

// At room temperature it conducts ten times as well as where it is hot.
TEST(LumpedBlocks, KnowTheirErrorByTheLeastConductivityThatTheyMayHave) {
  const auto stated = [](const Curve& conductivity) {
    auto row = row_of_cubes<2>(1, 4);
    row.materials[MaterialId{0}].conductivity = conductivity;
    row.options.initial_temperature[BodyId{0}] = 1000.0;
    row.options.boundaries.push_back(test::convection(BodyId{0}, 5, 300.0));
    row.options.blocks.model = BlockModel::lumped;
    const HeatModel model = row.model();
    return std::pair(biot_range(*model.lumped).largest, test::heated(model).lumping.largest);
  };
  const auto varying = stated(Curve::from_table(LinearTable({200, 300, 600, 1200}, {30, 30, 3, 3}))), least = stated(3.0);
  EXPECT_NEAR(varying.first, least.first, 1e-12 * least.first);
  EXPECT_NEAR(varying.second, least.second, 0.02 * least.second);
  const auto formula = stated(test::curve("3 + sqrt(T - 400)*0"));  // none below 400 K, where the air is
  EXPECT_NEAR(formula.first, least.first, 1e-12 * least.first);
}

// A source heats it to where it conducts a tenth as well, which nothing is at the start.
TEST(LumpedBlocks, KnowTheirErrorByTheLeastConductivityThatTheyComeToHave) {
  const auto row_with = [](const Curve& conductivity, BlockModel blocks) {
    auto row = row_of_cubes<2>(1, 8);
    row.materials[MaterialId{0}].conductivity = conductivity;
    row.options.initial_temperature[BodyId{0}] = 300.0;
    row.options.boundaries.push_back(test::convection(BodyId{0}, 5, 300.0));
    row.options.sources.push_back({test::on(BodyId{0}, test::between_x(0, 0.5 * test::side)), 4e5, "source", {}});
    row.options.blocks.model = blocks;
    return row.model();
  };
  const Curve falling = Curve::from_table(LinearTable({200, 300, 350, 2000}, {40, 40, 4, 4}));
  const auto states = [&](const Curve& conductivity, BlockModel blocks) {
    const HeatModel model = row_with(conductivity, blocks);
    return std::vector<HeatState>{test::heated(model, 36000), find_steady_state(model, LinearSolver::cholesky).state};
  };
  const auto varying = states(falling, BlockModel::lumped), least = states(4.0, BlockModel::lumped);
  const auto meshed = states(falling, BlockModel::meshed);
  for (std::size_t i = 0; i < varying.size(); ++i) {
    EXPECT_NEAR(varying[i].lumping.largest, least[i].lumping.largest, 0.02 * least[i].lumping.largest) << i;
    const double mean = varying[i].temperature[0];
    EXPECT_GT(varying[i].lumping.largest, (meshed[i].temperature.array() - mean).abs().maxCoeff()) << i;
  }
}

TEST(LumpedBlocks, HaveNoErrorBeyondTheTemperaturesThatThereAreUnlessSomethingHeatsThem) {
  auto row = row_of_cubes<3>(2, 2);
  row.options.initial_temperature[BodyId{0}] = 300.0;
  row.options.boundaries.push_back(test::convection(BodyId{0}, 1e5, 400.0));
  row.options.blocks.model = BlockModel::lumped;
  const double alone = test::heated(row.model()).lumping.largest;
  EXPECT_LE(alone, 100 * (1 + 1e-12));
  EXPECT_GT(alone, 90);
  row.options.sources.push_back({test::on(BodyId{1}), 1.0, "source", {}});
  EXPECT_GT(test::heated(row.model()).lumping.largest, 500);
}

TEST(LumpedBlocks, MakeAMeshedStateUnfit) {
  auto row = row_of_cubes<2>(1, 1);
  TimeOptions options;
  options.until = 1;
  HeatState state = HeatRun(row.model(), options).state();
  row.options.blocks.model = BlockModel::lumped;
  EXPECT_THROW(HeatRun(row.model(), options, state), InputError);
}

}  // namespace
}  // namespace scree::thermal
