#include "engine/base/curve.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "engine/base/material.h"

namespace scree {

namespace {

Curve formula(const std::string& text, Range range = positive) {
  ValueRule rule;
  rule.key = "materials.ore.conductivity";
  rule.quantity = quantity::conductivity;
  rule.range = range;
  return Curve::from_expression(text, std::get<UnitConverter>(unit_converter("W/m/K", quantity::conductivity)), rule);
}

// A hundred thousand midpoints.
double midpoint_integral(const Curve& curve, double to) {
  constexpr int count = 100000;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += curve((i + 0.5) * to / count);
  return sum * to / count;
}

TEST(Curve, ANumberIsTheSameAtEveryTemperature) {
  const Curve curve = 800;
  EXPECT_EQ(curve(300), 800);
  EXPECT_EQ(curve.integral(300), 240000);
  EXPECT_EQ(curve.constant(), 800);
}

TEST(Curve, ATableIsLinearInBetweenAndConstantBeyond) {
  const Curve curve = Curve::from_table(LinearTable({300, 400, 600}, {1, 3, 2}));
  EXPECT_EQ(curve.constant(), std::nullopt);
  EXPECT_EQ(curve(200), 1);
  EXPECT_NEAR(curve(350), 2, 1e-14);
  EXPECT_NEAR(curve(500), 2.5, 1e-14);
  EXPECT_EQ(curve(700), 2);
}

TEST(Curve, TheIntegralOfATableIsExact) {
  const Curve curve = Curve::from_table(LinearTable({300, 400, 600}, {1, 3, 2}));
  EXPECT_EQ(curve.integral(0), 0);
  EXPECT_NEAR(curve.integral(300), 300, 1e-12);
  EXPECT_NEAR(curve.integral(350), 300 + 75, 1e-12);
  EXPECT_NEAR(curve.integral(400), 300 + 200, 1e-12);
  EXPECT_NEAR(curve.integral(600), 300 + 200 + 500, 1e-12);
  EXPECT_NEAR(curve.integral(650), 300 + 200 + 500 + 100, 1e-12);
  const Curve one = Curve::from_table(LinearTable({300}, {5}));
  EXPECT_NEAR(one.integral(700), 3500, 1e-12);
}

TEST(Curve, TheSlopeOfATableIsThatOfTheIntervalAbove) {
  const Curve curve = Curve::from_table(LinearTable({300, 400, 600}, {1, 3, 2}));
  EXPECT_EQ(curve.slope(200), 0);
  EXPECT_EQ(curve.slope(300), 0.02);
  EXPECT_EQ(curve.slope(400), -0.005);
  EXPECT_EQ(curve.slope(599), -0.005);
  EXPECT_EQ(curve.slope(600), 0);
  EXPECT_EQ(Curve(800).slope(300), 0);
  EXPECT_EQ(Curve::from_table(LinearTable({300}, {5})).slope(300), 0);
}

TEST(Curve, TheSlopeOfAFormulaIsItsDerivativeWhereItIsSmooth) {
  const Curve wave = formula("3 + sin(T/20) + exp(-T/100)");
  for (const double T : {0.0, 0.3, 273.15, 999.99, 1234.5, 4999.5, 5000.0, 6100.3}) {
    EXPECT_NEAR(wave.slope(T), std::cos(T / 20) / 20 - std::exp(-T / 100) / 100, 1e-8) << T;
  }
  EXPECT_EQ(wave.slope(-1), 0);
  const Curve kink = formula("1 + abs(T - 400.7)");
  EXPECT_NEAR(kink.slope(400.5), -1, 1e-8);
  EXPECT_NEAR(kink.slope(400.9), 1, 1e-8);
}

TEST(Curve, TheIntegralOfAFormulaMatchesItsAntiderivative) {
  const Curve cubic = formula("2 + 1e-3*T + 4e-9*T^3");
  for (const double T : {0.0, 0.3, 273.15, 1234.5, 5000.0, 6100.0}) {
    EXPECT_NEAR(cubic.integral(T) - cubic.integral(0), 2 * T + 0.5e-3 * T * T + 1e-9 * std::pow(T, 4), 1e-10 * (1 + T)) << T;
  }
  const Curve wave = formula("3 + sin(T/20) + exp(-T/100)");
  EXPECT_NEAR(wave.integral(431.7) - wave.integral(0), midpoint_integral(wave, 431.7), 1e-5);
}

// As hot as an arc.
TEST(Curve, AFormulaIsKnownToFiftyThousandKelvinAndRefusedFromThereOn) {
  const Curve inverse = formula("1000/T");
  EXPECT_NEAR(inverse.integral(49999) - inverse.integral(4000), 1000 * std::log(49999.0 / 4000), 1e-9);
  const Curve jump = formula("2 + 40*(T > 6543.21)");
  EXPECT_NEAR(jump.integral(6600) - jump.integral(6500), 2 * 100 + 40 * (6600 - 6543.21), 1e-8);
  for (const double T : {5e4, 1e6}) {
    EXPECT_THROW(static_cast<void>(inverse(T)), InputError) << T;
    EXPECT_THROW(static_cast<void>(inverse.integral(T)), InputError) << T;
  }
}

TEST(Curve, TheIntegralOfAFormulaThatJumpsIsExactAndNeverFalls) {
  const Curve jump = formula("2 + 40*(T > 299.3)");
  double before = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double T = 298.5 + i * 1e-3;
    const double integral = jump.integral(T) - jump.integral(0);
    EXPECT_NEAR(integral, 2 * T + 40 * std::max(0.0, T - 299.3), 1e-9) << T;
    EXPECT_GT(integral, before) << T;
    before = integral;
  }
  const Curve kink = formula("1 + abs(T - 400.7)");
  EXPECT_NEAR(kink.integral(402) - kink.integral(0), 402 + 0.5 * (400.7 * 400.7 + 1.3 * 1.3), 1e-7);
}

TEST(Curve, ANarrowSmoothPeakCountsWhereverItLies) {
  for (const double middle : {272.9, 273.15, 273.3173, 273.47}) {
    for (const double width : {0.009, 0.011, 0.03, 0.1}) {
      const Curve peak =
          formula(fmt::format("2000 + 334000/({0}*sqrt(3.141592653589793))*exp(-((T - {1})/{0})^2)", width, middle));
      EXPECT_NEAR(peak.integral(middle + 2) - peak.integral(middle - 2), 8000 + 334000, 1e-3) << middle << ", " << width;
    }
  }
}

// What a formula that bends suddenly does between Gauss's points, which are up to 0.135 K apart.
TEST(Curve, ANarrowPeakCountsWhereverItLies) {
  for (const double begin : {0.001, 272.9, 273.0, 273.12, 273.47, 273.97}) {
    for (const double width : {0.025, 0.05, 0.1, 0.3}) {
      const Curve peak = formula(fmt::format("T > {} && T < {} ? 3344 : 4", begin, begin + width));
      EXPECT_NEAR(peak.integral(begin + 2) - peak.integral(std::max(0.0, begin - 2)),
                  4 * (2 + std::min(2.0, begin)) + 3340 * width, 1e-6)
          << begin << ", " << width;
      EXPECT_EQ(peak(begin + 0.5 * width), 3344) << begin << ", " << width;
      EXPECT_EQ(peak(begin + 1.01 * width), 4) << begin << ", " << width;
      const Curve hat = formula(fmt::format("4 + 1000*max(0, 1 - abs(T - {})/{})", begin + 0.5 * width, 0.5 * width));
      EXPECT_NEAR(hat.integral(begin + 2) - hat.integral(begin), 8 + 500 * width, 1e-6) << begin << ", " << width;
    }
  }
}

TEST(Curve, AJumpBesideTheEndOfAKelvinIsWhereItIs) {
  for (const double jump : {299.99, 299.9999, 300.0, 300.0001, 300.01}) {
    const Curve curve = formula(fmt::format("T < {} ? 500 : 5", jump));
    EXPECT_EQ(curve(jump - 1e-5), 500) << jump;
    EXPECT_EQ(curve(jump + 1e-5), 5) << jump;
    EXPECT_NEAR(curve.integral(302) - curve.integral(298), 500 * (jump - 298) + 5 * (302 - jump), 1e-8) << jump;
  }
}

TEST(Curve, DifferencesNearZeroKelvinAreExactOfAFormulaThatVanishesThere) {
  const Curve curve = formula("0.0107*T + 7.6e-4*T^3");
  const auto antiderivative = [](double at) { return 0.5 * 0.0107 * at * at + 0.25 * 7.6e-4 * std::pow(at, 4); };
  for (const double T : {0.02, 0.7, 4.2, 77.0, 300.0, 1000.0}) {
    const double exact = antiderivative(1.1 * T) - antiderivative(T);
    EXPECT_NEAR((curve.integral(1.1 * T) - curve.integral(T)) / exact, 1, 1e-11) << T;
  }
}

TEST(Curve, DifferencesAreExactOfAFormulaThatGrowsBeyondAllBoundsTowardsZeroKelvin) {
  const Curve curve = formula("100*(300/T)^2");
  for (const double T : {301.0, 487.5, 1300.0, 4999.5})
    EXPECT_NEAR(curve.integral(T) - curve.integral(300), 9e6 * (1.0 / 300 - 1 / T), 1e-9) << T;
  EXPECT_NEAR(curve.integral(300) - curve.integral(20), 9e6 * (1.0 / 20 - 1.0 / 300), 1e-6);
}

TEST(Curve, TheIntegralOfAFormulaReachesAsFarAsItHasValues) {
  const Curve curve = formula("sqrt(T - 100.3) + 0*sqrt(1500 - T)");
  const auto antiderivative = [](double at) { return 2.0 / 3 * std::pow(at - 100.3, 1.5); };
  for (const double from : {101.0, 200.0, 900.5})
    EXPECT_NEAR(curve.integral(1400) - curve.integral(from), antiderivative(1400) - antiderivative(from), 1e-8) << from;
  EXPECT_THROW((void)curve.integral(50), InputError);
  EXPECT_THROW((void)curve.integral(2000), InputError);
}

TEST(Curve, AFormulaThatBreaksItsRuleNamesTheTemperature) {
  const Curve falling = formula("10 - 0.01*T");
  EXPECT_NEAR(falling(900), 1, 1e-12);
  try {
    falling(1100);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "materials.ore.conductivity is -1 W/m/K at 1100 K (must be positive, W/m/K). The formula is 10 - 0.01*T");
  }
  EXPECT_THROW(formula("1 + x"), InputError) << "only T is known";
  EXPECT_THROW(formula("1 - 2"), InputError) << "a formula of numbers is held against the rule at once";
}

TEST(Conductivity, ItsMeanIsTheMeanOverThePrincipalAxes) {
  Conductivity wood = formula("0.1*T");
  wood.ratio = {1, 0.5, 0.3};
  EXPECT_FALSE(wood.isotropic());
  EXPECT_NEAR(wood.mean(20), (2 + 1 + 0.6) / 3, 1e-14);
  EXPECT_TRUE(Conductivity(4.0).isotropic());
}

}  // namespace

}  // namespace scree
