#include "thermal/time_bends.h"

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"

namespace scree::thermal {
namespace {

// From 0 to 1000 s, of loads in one bar.
TimeBends bends_of(const std::vector<std::string>& formulas) {
  static std::vector<std::shared_ptr<const HeatModel>> kept;  // they are referred to
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const auto mesh = test::slab_mesh<2>({test::bar<2>(1, 2, 1, 1)});
  HeatOptions options = test::options_for(mesh, 300);
  for (const std::string& formula : formulas) {
    options.sources.push_back({test::on(BodyId{0}, std::nullopt), Function::from_expression(formula, unit, {}), formula, {}});
  }
  kept.push_back(
      std::make_shared<const HeatModel>(make_heat_model(mesh, test::rock_only(), contact::ContactSet<2>{}, options)));
  return {*kept.back(), 0, 1000};
}

std::vector<double> jumps_of(const std::vector<std::string>& formulas) {
  std::vector<double> times;
  const TimeBends bends = bends_of(formulas);
  for (const Jump& jump : bends.jumps()) {
    EXPECT_LT(jump.before, jump.after);
    EXPECT_LT(jump.after - jump.before, 2e-11);
    times.push_back(0.5 * (jump.before + jump.after));
  }
  return times;
}

void expect_jumps(const std::vector<std::string>& formulas, const std::vector<double>& expected) {
  const std::vector<double> found = jumps_of(formulas);
  ASSERT_EQ(found.size(), expected.size()) << formulas.front();
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-11) << formulas.front();
}

TEST(TimeBends, JumpsAreFoundToRounding) {
  expect_jumps({"t < 123.456 ? 1 : 2"}, {123.456});
  expect_jumps({"t <= 123.456 ? 1 : 2"}, {123.456});
  expect_jumps({"5*(t > 100)*(t < 900.5) + sin(t/50)"}, {100, 900.5});
  expect_jumps({"(t > 300)*(t - 300) + 20*(t > 500)"}, {500});
  expect_jumps({"t + 9*(t > 510.3) + 2.5*(t > 800.1)"}, {510.3, 800.1});
  expect_jumps({"sin(t/50) + (t > 2000)"}, {});
}

TEST(TimeBends, AJumpAtTheEndBelongsToTheTimeBeforeIt) {
  expect_jumps({"t < 1000 ? 1 : 2"}, {1000});
  expect_jumps({"t <= 1000 ? 1 : 2"}, {1000});  // a step's time that is rounded up would see it
}

TEST(TimeBends, AJumpAtTheBeginningIsThereOnlyIfTheBeginningIsBeforeIt) {
  expect_jumps({"t <= 0 ? 1 : 2"}, {0});
  expect_jumps({"t < 0 ? 1 : 2"}, {});
}

TEST(TimeBends, JumpsOfSeveralAtOneTimeAreOne) {
  expect_jumps({"t < 250.1 ? 1 : 2", "t <= 250.1 ? 3 : 2", "t < 100 ? 0 : 7"}, {100, 250.1});
}

TEST(TimeBends, WhatIsSteepIsNoJump) {
  expect_jumps({"sin(t)"}, {});
  expect_jumps({"exp(-((t - 500)/0.5)^2)"}, {});
  expect_jumps({"t < 500 ? 0 : (t < 500.001 ? 1000*(t - 500) : 1)"}, {});
}

TEST(TimeBends, AFormulaThatDependsOnPlaceHasBendsInsteadOfJumps) {
  expect_jumps({"t < 500 ? x : 2"}, {});
  EXPECT_TRUE(bends_of({"t < 500 ? x : 2"}).any_between(400, 600));
}

TEST(TimeBends, OnlyWhatComparesChoosesOrRoundsMayJumpWhereItBends) {
  for (const std::string smooth : {"sin(t/50)", "x + sin(t/50)"}) {
    EXPECT_TRUE(bends_of({smooth}).any_between(0, 1000)) << smooth;
    EXPECT_FALSE(bends_of({smooth}).may_jump_between(0, 1000)) << smooth;
  }
  for (const std::string sudden : {"t < 500 ? x : 2", "t > 700 ? 0.01*(t - 700) : 0"}) {
    EXPECT_TRUE(bends_of({sudden}).may_jump_between(690, 710)) << sudden;
  }
}

TEST(TimeBends, AJumpIsNoBendButWhatBendsBesideItIs) {
  const TimeBends jump = bends_of({"t < 500.3 ? 1 : 2"});
  EXPECT_FALSE(jump.any_between(0, 1000));
  const TimeBends both = bends_of({"(t < 500.3 ? 1 : 2) + (t > 700 ? 0.01*(t - 700) : 0)"});
  EXPECT_FALSE(both.any_between(0, 690));
  EXPECT_TRUE(both.any_between(690, 710));
  EXPECT_EQ(both.most_between(0, 1000), 1);
}

}  // namespace
}  // namespace scree::thermal
