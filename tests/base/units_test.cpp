#include "engine/base/units.h"

#include <numbers>

#include <gmock/gmock.h>

namespace scree {

namespace {

struct Case {
  const char* text;
  Quantity quantity;
  double si;
};

double value_of(const char* text, const Quantity& quantity) {
  const auto parsed = parse_quantity(text, quantity);
  EXPECT_TRUE(std::holds_alternative<double>(parsed)) << text << ": " << std::get<UnitProblem>(parsed).reason;
  return std::holds_alternative<double>(parsed) ? std::get<double>(parsed) : 0;
}

std::string reason_of(const char* text, const Quantity& quantity) {
  const auto parsed = parse_quantity(text, quantity);
  EXPECT_TRUE(std::holds_alternative<UnitProblem>(parsed)) << text;
  if (std::holds_alternative<double>(parsed)) return "";
  const auto& problem = std::get<UnitProblem>(parsed);
  return problem.reason + (problem.suggestion.empty() ? "" : " | " + problem.suggestion);
}

namespace q = quantity;

TEST(Units, ConvertToSi) {
  const Case cases[] = {
      {"12 h", q::time, 43200},
      {"10 min", q::time, 600},
      {"7 d", q::time, 604800},
      {"5ms", q::time, 0.005},
      {"4 cm", q::length, 0.04},
      {"0.1 mm", q::length, 1e-4},
      {"3 µm", q::length, 3e-6},
      {" +2e-1 km ", q::length, 200},
      {"373 K", q::temperature, 373},
      {"100 degC", q::temperature, 373.15},
      {"-40 degF", q::temperature, 233.15},
      {"25 °C", q::temperature, 298.15},
      {"0.1 degC", q::temperature_difference, 0.1},
      {"0.18 degF", q::temperature_difference, 0.1},
      {"10 mK", q::temperature_difference, 0.01},
      {"3.1 W/m/K", q::conductivity, 3.1},
      {"3.1 W/(m K)", q::conductivity, 3.1},
      {"3.1 W m-1 K-1", q::conductivity, 3.1},
      {"3.1 W m⁻¹ K⁻¹", q::conductivity, 3.1},
      {"5 kW·m⁻²·K⁻¹", q::heat_transfer, 5000},
      {"2 kg/m³", q::density, 2},
      {"3.1 W/m/degC", q::conductivity, 3.1},
      {"880 J/kg/K", q::specific_heat, 880},
      {"0.88 kJ/(kg K)", q::specific_heat, 880},
      {"2500 kg/m3", q::density, 2500},
      {"2.5 g/cm3", q::density, 2500},
      {"2.5 t/m^3", q::density, 2500},
      {"5 kW/m2", q::heat_flux, 5000},
      {"2 W", q::heat_flow, 2},
      {"1 MW/m3", q::power_density, 1e6},
      {"9.81 m/s2", q::acceleration, 9.81},
      {"36 km/h", q::speed, 10},
      {"10 s-1", q::rate, 10},
      {"600 1/min", q::rate, 10},
      {"10/s", q::rate, 10},
      {"45 deg", q::angle, std::numbers::pi / 4},
      {"1 rad", q::angle, 1},
      {"5 %", q::number, 0.05},
      {"2 ft", q::length, 0.6096},
      {"1 inch", q::length, 0.0254},
      {"1 common_year", q::time, 365 * 86400},
  };
  for (const Case& c : cases) EXPECT_NEAR(value_of(c.text, c.quantity), c.si, 1e-13 * std::abs(c.si)) << c.text;
}

// A foot is in the long table of UDUNITS alone. What nearly all scenes name is looked up in the shorter ones.
TEST(Units, AreTheSameWhicheverTableTheyAreReadFrom) {
  const std::pair<const char*, Quantity> cases[] = {
      {"m", q::length},
      {"cm", q::length},
      {"mm", q::length},
      {"um", q::length},
      {"km", q::length},
      {"s", q::time},
      {"ms", q::time},
      {"min", q::time},
      {"h", q::time},
      {"d", q::time},
      {"day", q::time},
      {"days", q::time},
      {"K", q::temperature_difference},
      {"mK", q::temperature_difference},
      {"degC", q::temperature_difference},
      {"kg/m3", q::density},
      {"g/cm3", q::density},
      {"t/m^3", q::density},
      {"J/(kg K)", q::specific_heat},
      {"kJ/(kg K)", q::specific_heat},
      {"MJ/(kg K)", q::specific_heat},
      {"W", q::heat_flow},
      {"mW", q::heat_flow},
      {"kW", q::heat_flow},
      {"MW", q::heat_flow},
      {"N m/s", q::heat_flow},
      {"kN m/s", q::heat_flow},
      {"Pa m3/s", q::heat_flow},
      {"kPa m3/s", q::heat_flow},
      {"MPa m3/s", q::heat_flow},
      {"bar m3/s", q::heat_flow},
      {"rad", q::angle},
      {"deg", q::angle},
      {"%", q::number},
  };
  for (const auto& [unit, quantity] : cases) {
    const auto value = [&](const std::string& spelling) { return value_of(("7 " + spelling).c_str(), quantity); };
    const double by_long_table = value(std::string(unit) + " ft/ft");
    EXPECT_NEAR(value(unit), by_long_table, 1e-14 * by_long_table) << unit;
  }
}

TEST(Units, BareNumbersAreSiToTheBit) {
  EXPECT_EQ(value_of("0.1", q::length), 0.1);
  EXPECT_EQ(value_of("1e-3", q::time), 1e-3);
  EXPECT_EQ(value_of("298.15", q::temperature), 298.15);
  EXPECT_EQ(value_of(".5", q::number), 0.5);
  EXPECT_EQ(value_of("-0.025", q::length), -0.025);
}

TEST(Units, AWrongDimensionIsRefused) {
  EXPECT_EQ(reason_of("3 kg", q::length), "kg is no unit of length | Write it in m or another unit of length");
  EXPECT_EQ(reason_of("12 m", q::time), "m is no unit of time | Did you mean 12 min?");
  EXPECT_EQ(reason_of("25 C", q::temperature), "C is no unit of temperature | Did you mean 25 degC?");
  for (const char* written : {"25 deg C", "25 oC", "25 degrees Celsius"}) {
    EXPECT_THAT(reason_of(written, q::temperature), testing::EndsWith("Did you mean 25 degC?")) << written;
  }
  EXPECT_EQ(reason_of("3.1 W/m", q::conductivity), "W/m is no unit of conductivity | Did you mean 3.1 W/m/K?");
  EXPECT_EQ(reason_of("5 m", q::number), "m is no unit of a plain number | Did you mean 5?");
  EXPECT_EQ(reason_of("45 %", q::angle), "% is no unit of angle | Write it in rad or another unit of angle");
  EXPECT_EQ(reason_of("45 deg", q::number), "deg is no unit of a plain number | Did you mean 45?");
}

TEST(Units, WhatIsSuggestedIsTheSameValueInAnotherSpelling) {
  for (const auto& [written, quantity, meant] :
       std::vector<std::tuple<const char*, Quantity, const char*>>{{"0.88 kJ/kgK", q::specific_heat, "0.88 kJ/kg/K"},
                                                                   {"2 kW/m2K", q::heat_transfer, "2 kW/m2/K"},
                                                                   {"3100 mW/mK", q::conductivity, "3100 mW/m/K"},
                                                                   {"3 W/m·K", q::conductivity, "3 W/m/K"},
                                                                   {"50 mms", q::length, "50 mm"},
                                                                   {"60 mins", q::time, "60 min"},
                                                                   {"10 Min", q::time, "10 min"},
                                                                   {"2 H", q::time, "2 h"},
                                                                   {"20 deg", q::temperature, "20 degC"},
                                                                   {"68 F", q::temperature, "68 degF"}}) {
    EXPECT_THAT(reason_of(written, quantity), testing::EndsWith(std::string("Did you mean ") + meant + "?")) << written;
  }
  for (const char* written : {"1 y", "1h30min", "1/2 h", "3 fortnightz"}) {
    EXPECT_THAT(reason_of(written, q::time), testing::EndsWith("Write it in s or another unit of time")) << written;
  }
  EXPECT_EQ(reason_of("2,5", q::density), "not a number | Write decimals with a point");
  for (const char* written : {"1:00:00", "2*1800 s", "2_500 s"}) {
    EXPECT_EQ(reason_of(written, q::time), "not a number | Write it as one number") << written;
  }
}

TEST(Units, AReciprocalIsRefused) {
  for (const auto& [text, quantity] : {std::pair{"4 Hz", q::time},
                                       {"2 s-1", q::time},
                                       {"40 m-1", q::length},
                                       {"2 m-3", q::length},
                                       {"0.001 m3/kg", q::density},
                                       {"0.5 m K/W", q::conductivity},
                                       {"10 K-1", q::temperature}}) {
    EXPECT_THAT(reason_of(text, quantity), testing::HasSubstr("is no unit of")) << text;
  }
  EXPECT_TRUE(std::holds_alternative<UnitProblem>(unit_converter("Hz", q::time)));
}

TEST(Units, UnknownUnitsAndOddSpellingsAreRefused) {
  EXPECT_EQ(reason_of("3 furlongz", q::length), "furlongz is no known unit | Write it in m or another unit of length");
  EXPECT_EQ(reason_of("3 m 2", q::length), "m 2 is no known unit | Write it in m or another unit of length");
  EXPECT_EQ(reason_of("3 2 m", q::length), "2 m is no known unit | Write it in m or another unit of length");
  const auto zero_byte = parse_quantity(std::string_view("3 m\0 2", 6), q::length);
  EXPECT_TRUE(std::holds_alternative<UnitProblem>(zero_byte)) << "what follows it is not left out";
  EXPECT_EQ(reason_of("3 K @ 5", q::temperature), "K @ 5 is no known unit | Write it in K or another unit of temperature");
  EXPECT_EQ(reason_of("3 s since 2000", q::time), "s since 2000 is no known unit | Write it in s or another unit of time");
  EXPECT_EQ(reason_of("3 m/", q::length), "m/ is no known unit | Write it in m or another unit of length");
}

TEST(Units, OnlyFiniteNumbersPass) {
  for (const char* text : {"", "  ", "x", "inf", "-inf", "nan", ".inf", ".nan", "h", "- 3", "--3", "+-3"}) {
    EXPECT_EQ(reason_of(text, q::number), "not a number") << text;
  }
  EXPECT_EQ(reason_of("1e999", q::number), "too large or too small for a number in double precision");
  EXPECT_EQ(reason_of("1e308 km", q::length), "too large for a number in double precision");
}

}  // namespace

}  // namespace scree
