#include "engine/base/function.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>

#include "tests/temp_folder.h"

namespace scree {

namespace {

using testing::HasSubstr;

ValueRule rule_of(const Quantity& quantity, Range range = {}) {
  ValueRule rule;
  rule.key = "heat.here";
  rule.where = {"s.yaml", 3, 7};
  rule.quantity = quantity;
  rule.range = range;
  return rule;
}

Function formula(const std::string& text, const char* unit = "", const Quantity& quantity = quantity::number,
                 Range range = {}) {
  return Function::from_expression(text, std::get<UnitConverter>(unit_converter(unit, quantity)), rule_of(quantity, range));
}

Function table(const std::string& text, const Quantity& quantity, Range range = {}) {
  const auto file = test::temp_folder() / "table.csv";
  std::ofstream(file) << text;
  return Function::from_table(file, rule_of(quantity, range));
}

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();

TEST(Function, ANumberIsTheSameEverywhereAndAlways) {
  const Function function = 7.5;
  EXPECT_EQ(function({1, 2, 3}, 4), 7.5);
  EXPECT_EQ(function.constant(), 7.5);
  EXPECT_FALSE(function.varies_in_time());
  EXPECT_FALSE(function.varies_in_place());
}

TEST(Function, AFormulaIsWhatItSays) {
  const Function function = formula("x + 10*y - z^2 + 100*sin(2*pi*t) + (x > 0.5 ? 1000 : 0)");
  const Eigen::Vector3d place(0.25, -3, 1.5);
  EXPECT_NEAR(function(place, 1.0 / 12), 0.25 - 30 - 2.25 + 100 * std::sin(std::numbers::pi / 6), 1e-12);
  EXPECT_NEAR(function(place + Eigen::Vector3d::UnitX(), 0) - function(place, 0), 1001, 1e-12);
  EXPECT_EQ(formula("-2^2").constant(), -4) << "a sign binds less than a power";
}

TEST(Function, KnowsWhatItDependsOn) {
  EXPECT_TRUE(formula("3*t").varies_in_time());
  EXPECT_FALSE(formula("3*t").varies_in_place());
  EXPECT_TRUE(formula("z/2").varies_in_place());
  EXPECT_FALSE(formula("z/2").varies_in_time());
  EXPECT_EQ(formula("2*pi").constant(), 2 * std::numbers::pi) << "a formula of numbers is a number";
}

TEST(Function, AFormulasUnitIsConvertedWithItsOrigin) {
  EXPECT_NEAR(formula("25 + 100*x", "degC", quantity::temperature)({0.5, 0, 0}, 0), 348.15, 1e-9);
  EXPECT_NEAR(formula("x", "kW/m2", quantity::heat_flux)({2, 0, 0}, 0), 2000, 1e-9);
}

TEST(Function, AMistakeInAFormulaIsNamedWithItsPlace) {
  EXPECT_THAT(message_of([] { formula("25 + 100*w"); }),
              testing::StartsWith("s.yaml:3:7: heat.here is 25 + 100*w (must be a formula in x, y, z and t; w at its character "
                                  "10 is no known name; known are x, y, z, t, pi, abs, "));
  EXPECT_THAT(message_of([] { formula("sim(x)"); }), HasSubstr("Did you mean sin?"));
  EXPECT_THAT(message_of([] { formula("(x + 1"); }), HasSubstr("Missing parenthesis at its character 7"));
  EXPECT_THAT(message_of([] { formula("x *"); }), HasSubstr("Unexpected end of expression at its character 4"));
  EXPECT_THAT(message_of([] { formula(""); }), HasSubstr("must be a formula"));
  EXPECT_THAT(message_of([] { formula("x = 3"); }), HasSubstr("assigns). Did you mean ==?"));
  EXPECT_THAT(message_of([] { formula("1, 2"); }), HasSubstr("more than one value"));
}

TEST(Function, AForbiddenValueNamesPlaceAndTime) {
  const Function kelvin = formula("300 - 100*t", "K", quantity::temperature, not_negative);
  EXPECT_EQ(kelvin(nowhere, 3), 0);
  EXPECT_EQ(
      message_of([&] {
        kelvin({1, 2, 3}, 3.5);
      }),
      "s.yaml:3:7: heat.here is -50 K at x = 1 m, y = 2 m, z = 3 m and t = 3.5 s (must be not negative, K). The formula is "
      "300 - 100*t");
  EXPECT_THAT(message_of([] { formula("1/x")(nowhere, 0); }), HasSubstr("is inf at x = 0 m"));
  EXPECT_THAT(message_of([] { formula("sqrt(x)")({-1, 0, 0}, 0); }), HasSubstr("nan at x = -1 m"));
}

TEST(Function, SeveralThreadsGetTheirOwnValues) {
  const Function function = formula("x*x + t");
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int n = 0; n < 5000; ++n) {
        const double x = i + n;
        wrong[i] += function({x, 0, 0}, 0.5) == x * x + 0.5 ? 0 : 1;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_THAT(wrong, testing::Each(0));
}

TEST(Function, FormulasOfTheSameTextDoNotGetInEachOthersWay) {
  auto first = std::make_optional(formula("x + t"));
  const Function second = formula("x + t");
  EXPECT_EQ((*first)({1, 0, 0}, 2), 3);
  EXPECT_EQ(second({10, 0, 0}, 20), 30);
  EXPECT_EQ((*first)({1, 0, 0}, 2), 3);
  first.reset();
  EXPECT_EQ(second({10, 0, 0}, 20), 30);
  EXPECT_EQ(formula("x + t")({5, 0, 0}, 6), 11);
}

TEST(Function, ATableMayBeginWithTheByteOrderMarkOfASpreadsheet) {
  EXPECT_NEAR(table("\xEF\xBB\xBFtime [s], temperature [K]\n0, 300\n2, 400\n", quantity::temperature)(nowhere, 1), 350, 1e-9);
}

TEST(Function, ATableIsLinearInBetweenInItsUnits) {
  const Function function =
      table("# an oven\ntime [h], temperature [degC]\n0, 20\n\n 1 , 120 # hot\n3,20\n", quantity::temperature);
  EXPECT_TRUE(function.varies_in_time());
  EXPECT_FALSE(function.varies_in_place());
  EXPECT_NEAR(function(nowhere, 0), 293.15, 1e-9);
  EXPECT_NEAR(function(nowhere, 1800), 343.15, 1e-9);
  EXPECT_NEAR(function(nowhere, 7200), 343.15, 1e-9);
  EXPECT_NEAR(function(nowhere, 10800 * (1 + 1e-12)), 293.15, 1e-9) << "rounding is no reason to refuse";
}

TEST(Function, ATableOverAPlaceIsOneOfPlace) {
  const Function function = table("y [cm],power [kW/m3]\n0,0\n100,5\n", quantity::power_density);
  EXPECT_TRUE(function.varies_in_place());
  EXPECT_NEAR(function({9, 0.2, 9}, 1e6), 1000, 1e-9);
}

TEST(Function, ATableIsNotContinuedBeyondItsEnds) {
  const Function function = table("time [s],flux [W/m2]\n10,1\n20,2\n", quantity::heat_flux);
  EXPECT_THAT(message_of([&] { function(nowhere, 25); }), HasSubstr("reaches from 10 to 20 s"));
  EXPECT_EQ(message_of([&] { function.check_time(10, 20); }), "accepted");
  EXPECT_THAT(message_of([&] { function.check_time(0, 20); }), HasSubstr("too short for a run from 0 to 20 s"));
  EXPECT_THAT(message_of([&] { function.check_time(10, 21); }), HasSubstr("too short for a run from 10 to 21 s"));
}

TEST(Function, AMistakeInATableIsNamedWithLineAndColumn) {
  const auto wrong = [](const std::string& text) {
    const std::string message = message_of([&] { table(text, quantity::temperature, not_negative); });
    return message.substr(std::min(message.find(".csv") + 4, message.size()));
  };
  EXPECT_EQ(wrong("tim [s],T [K]\n0,1\n"),
            ":1:1: table of heat.here is tim [s] (the first column must be time, x, y, z and its unit). Did you mean time?");
  EXPECT_EQ(wrong("time,T [K]\n0,1\n"), ":1:1: table of heat.here is time (must be a name and a unit). Write time [s]");
  EXPECT_EQ(wrong("time [s],T [m]\n0,1\n"),
            ":1:10: table of heat.here is T [m] (m is no unit of temperature). Write it in K or another unit of temperature");
  EXPECT_EQ(wrong("time [s],T [K]\n0,1\n1,x\n"), ":3:3: table of heat.here is x (not a number)");
  EXPECT_EQ(wrong("time [s],T [K]\n0,1\n0,2\n"),
            ":3:1: table of heat.here is 0 (must be above the one before). A jump is two places close together");
  EXPECT_EQ(wrong("time [s],T [K]\n0,1,2\n"),
            ":2:1: table of heat.here is a line of 3 columns (must have two, with a comma between them)");
  EXPECT_EQ(wrong("time [s],T [degC]\n0,-300\n"), ":2:3: table of heat.here is -26.85 K (must be not negative, K)");
  EXPECT_EQ(wrong("time [s],T [K]\n"), ": table of heat.here is without numbers (must have a head and at least one pair)");
  EXPECT_THAT(message_of([] { Function::from_table("nowhere.csv", rule_of(quantity::time)); }),
              HasSubstr("s.yaml:3:7: heat.here is nowhere.csv (the table cannot be read: No such file"));
}

}  // namespace

}  // namespace scree
