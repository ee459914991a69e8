#include <gmock/gmock.h>

#include "engine/base/checked_input.h"
#include "engine/base/key_reference.h"
#include "engine/base/key_row.h"

namespace scree {

namespace {

const KeyTable& animals() {
  static const KeyTable table(std::vector<Key>{
      row("zoo", KeyType::names, "Animals.").required().range(at_least_one),
      row("zoo.*", KeyType::section, "One animal."),
      row("zoo.*.mass", KeyType::quantity, "Its mass.", quantity::length, positive).required(),
      row("zoo.*.legs", KeyType::integer, "How many legs.", quantity::number, Range{.low = 0, .high = 8}).fallback("4"),
      row("zoo.*.food", KeyType::word, "What it eats.").words({"grass", "meat"}).fallback("grass"),
      row("zoo.*.prey", KeyType::text, "Whom it eats.").only({Condition{"zoo.*.food", "meat"}}),
      row("zoo.*.place", KeyType::quantity, "Where it is, or its path.", quantity::length).count(Count::per_dimension),
      row("zoo.*.place.from", KeyType::quantity, "Start.", quantity::length).required(),
      row("fence", KeyType::flag, "Is there one?").fallback("true"),
      row("days", KeyType::list, "Feeding."),
      row("days[]", KeyType::section, "One day."),
      row("days[].hay", KeyType::quantity, "Amount.").required().choice("meal"),
      row("days[].oats", KeyType::quantity, "Amount.").required().choice("meal"),
  });
  return table;
}

std::string wrong_with(const std::string& yaml) {
  std::vector<Problem> problems;
  check_input(parse_yaml(yaml, "z"), animals(), 2, problems);
  std::string text;
  for (const Problem& problem : problems) text += to_string(problem) + "\n";
  return text;
}

TEST(CheckInput, DefaultsAreFilledInAndUnitsConverted) {
  std::vector<Problem> problems;
  const Checked zoo = check_input(parse_yaml("zoo: {cow: {mass: 3 km, place: [1, 2 cm]}}", "z"), animals(), 2, problems);
  ASSERT_TRUE(problems.empty());
  const Checked& cow = zoo.at("zoo").at("cow");
  EXPECT_EQ(cow.at("mass").number(), 3000);
  EXPECT_EQ(cow.at("legs").integer(), 4);
  EXPECT_EQ(cow.at("place").vector(), Eigen::Vector3d(1, 0.02, 0));
  EXPECT_TRUE(zoo.at("fence").flag());
  EXPECT_FALSE(zoo.at("fence").given);
  EXPECT_EQ(cow.find("prey"), nullptr);
  EXPECT_EQ(zoo.find("days"), nullptr);
}

TEST(CheckInput, TheEffectiveInputChecksToItself) {
  std::vector<Problem> problems;
  const std::string yaml =
      "fence: false\nzoo: {lion: {food: meat, prey: \"a: b # c\", mass: 2}, b: {mass: 1, place: {from: 3}}}\n";
  const std::string once = to_yaml(check_input(parse_yaml(yaml, "z"), animals(), 2, problems));
  EXPECT_EQ(once,
            "zoo:\n  lion:\n    mass: 2\n    legs: 4\n    food: meat\n    prey: \"a: b # c\"\n"
            "  b:\n    mass: 1\n    legs: 4\n    food: grass\n    place:\n      from: 3\nfence: false\n");
  EXPECT_EQ(to_yaml(check_input(parse_yaml(once, "z"), animals(), 2, problems)), once);
  EXPECT_TRUE(problems.empty());
}

// A quantity in all its forms, alone and where names could stand as well.
const KeyTable& weather() {
  static const KeyTable table(std::vector<Key>{
      row("wind", KeyType::quantity, "Speed.", quantity::speed, not_negative).depends(Depends::on_place_and_time),
      row("air", KeyType::quantity, "Of all towns, or of each.", quantity::temperature)
          .depends(Depends::on_place_and_time)
          .required(),
      row("air.*", KeyType::quantity, "Of this town.", quantity::temperature),
      row("ice", KeyType::quantity, "Conductivity.", quantity::conductivity, positive)
          .count(Count::one_or_per_dimension)
          .depends(Depends::on_temperature),
      row("ice.ratio", KeyType::quantity, "Ratio.").count(Count::per_dimension),
  });
  return table;
}

struct Outcome {
  Checked checked;
  std::string wrong;
};
Outcome weather_of(const std::string& yaml) {
  std::vector<Problem> problems;
  Outcome outcome{check_input(parse_yaml(yaml, "w"), weather(), 2, problems), ""};
  for (const Problem& problem : problems) outcome.wrong += to_string(problem) + "\n";
  return outcome;
}

TEST(CheckInput, AQuantityThatDependsOnSomethingHasThreeForms) {
  const Outcome outcome = weather_of(
      "wind: {expression: 3 + t, unit: km/h}\n"
      "air: {table: air.csv}\n"
      "ice: {table: [[-10 degC, 2 W/m/K], [273.15, 2.2]], ratio: [1, 0.5]}\n");
  ASSERT_EQ(outcome.wrong, "");
  EXPECT_EQ(outcome.checked.at("wind").at("expression").text, "3 + t");
  EXPECT_EQ(outcome.checked.at("air").at("table").text, "air.csv");
  const Checked& table = outcome.checked.at("ice").at("table");
  ASSERT_EQ(table.numbers.size(), 4u);
  EXPECT_NEAR(table.numbers[0], 263.15, 1e-9);
  EXPECT_EQ(table.numbers[3], 2.2);
  EXPECT_EQ(weather_of("air: 3\nwind: 4\nice: [1, 2]").checked.at("ice").vector(), Eigen::Vector3d(1, 2, 0));
  EXPECT_EQ(weather_of("air: 3\nice: 5").checked.at("ice").number(), 5);
}

TEST(CheckInput, NamesAndFormsAreToldApart) {
  EXPECT_EQ(weather_of("air: {york: 3, table: 5}").checked.at("air").at("table").number(), 5) << "a town called table";
  EXPECT_EQ(weather_of("air: {table: 5.csv}").checked.at("air").at("table").text, "5.csv");
}

TEST(CheckInput, AFormulaWhereANumberStandsIsToldHowToBeWritten) {
  EXPECT_EQ(weather_of("air: 25 + 5*sin(t)").wrong,
            "w:1:6: air is 25 + 5*sin(t) (must be a temperature, K). Write a formula as {expression: \"25 + 5*sin(t)\"}\n");
  EXPECT_EQ(weather_of("air: 1\nice: 3 - 0.01*T").wrong,
            "w:2:6: ice is 3 - 0.01*T (must be positive, W/m/K). Write a formula as {expression: \"3 - 0.01*T\"}\n");
}

TEST(CheckInput, FormsThatDoNotFitAreRefused) {
  EXPECT_EQ(weather_of("air: 1\nwind: {expression: t, table: a}").wrong,
            "w:2:23: wind.table is given beside expression (must have exactly one of expression, table). Keep one of them\n");
  EXPECT_EQ(weather_of("air: 1\nwind: {table: a, unit: m/s}").wrong,
            "w:2:18: wind.unit is without use (of use only with wind.expression). Take it out\n");
  EXPECT_EQ(weather_of("air: 1\nice: {table: [[3, 1], [2, 1]]}").wrong,
            "w:2:24: ice.table is 2 (must be above the one before). A jump is two places close together\n");
  EXPECT_EQ(weather_of("air: 1\nice: {table: [[3, -1]]}").wrong,
            "w:2:19: ice.table[0][1] is -1 (must be positive, W/m/K). Did you mean 1?\n");
  EXPECT_EQ(weather_of("air: 1\nice: {table: [[3 m, 1]]}").wrong,
            "w:2:16: ice.table[0][0] is 3 m (must be a temperature, K; m is no unit of temperature). Write it in K or another "
            "unit of temperature\n");
  EXPECT_EQ(weather_of("air: 1\nice: {table: [3, 1]}").wrong,
            "w:2:15: ice.table is 3 (must be a CSV file, or a list of pairs of temperature [K] and positive, W/m/K)\n");
  EXPECT_EQ(weather_of("air: 1\nwind: fast").wrong,
            "w:2:7: wind is fast (must be not negative, m/s; not a number, with or without a unit)\n");
  EXPECT_EQ(weather_of("air: 1\nwind: [3]").wrong,
            "w:2:7: wind is a list (must be not negative, m/s; or {expression, unit} in x, y, z, t, or {table})\n");
}

TEST(CheckInput, TheEffectiveInputKeepsEveryForm) {
  const std::string yaml =
      "wind: {expression: \"t > 3 ? 1 : 2\", unit: km/h}\nair: {york: 3}\nice: {table: [[1, 2], [3 degC, 4]], ratio: [1, 2]}\n";
  const std::string once = to_yaml(weather_of(yaml).checked);
  EXPECT_EQ(once,
            "wind:\n  expression: \"t > 3 ? 1 : 2\"\n  unit: \"km/h\"\nair:\n  york: 3\n"
            "ice:\n  table: [[1, 2], [3 degC, 4]]\n  ratio: [1, 2]\n");
  EXPECT_EQ(to_yaml(weather_of(once).checked), once);
}

TEST(KeyReference, AFormIsPartOfItsQuantity) {
  const std::string text = key_reference(weather(), "wind");
  EXPECT_THAT(text, testing::HasSubstr("wind  not negative, m/s; or {expression, unit} in x, y, z, t, or {table}"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("wind.expression")));
  const std::string schema = key_schema(weather(), "w");
  EXPECT_THAT(schema, testing::HasSubstr("\"expression\""));
  EXPECT_THAT(schema, testing::HasSubstr("\"prefixItems\""));
}

TEST(CheckInput, EveryKindOfMistakeHasItsText) {
  EXPECT_EQ(wrong_with(""), "z:1:1: zoo is missing (must be a map of names, at least 1)\n");
  EXPECT_EQ(wrong_with("3"), "z:1:1: the file is 3 (must be a map of keys)\n");
  EXPECT_EQ(wrong_with("zoo: {}"), "z:1:6: zoo is empty (must be a map of names, at least 1)\n");
  EXPECT_EQ(wrong_with("zoo: {a: 3}"), "z:1:10: zoo.a is 3 (must be a map of keys)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: }}"), "z:1:11: zoo.a.mass is empty (must be positive, m)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: [1]}}"), "z:1:17: zoo.a.mass is a list (must be positive, m)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, legs: 9}}"),
            "z:1:26: zoo.a.legs is 9 (must be a whole number, at least 0 and at most 8)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, legs: 1e1}}"),
            "z:1:26: zoo.a.legs is 1e1 (must be a whole number, at least 0 and at most 8)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, legs: 99999999999999999999}}"),
            "z:1:26: zoo.a.legs is 99999999999999999999 (must be a whole number, at least 0 and at most 8; too large)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, food: mest}}"),
            "z:1:26: zoo.a.food is mest (must be one of grass, meat). Did you mean meat?\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, prey: x}}"),
            "z:1:20: zoo.a.prey is without use (of use only with zoo.a.food: meat). Take it out\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, place: [1, 2, 3]}}"),
            "z:1:27: zoo.a.place is a list (must be a list of 2, each a length, m; it has 3)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, place: [1, nan]}}"),
            "z:1:31: zoo.a.place[1] is nan (must be a length, m; not a number, with or without a unit)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, place: {}}}"), "z:1:27: zoo.a.place.from is missing (must be a length, m)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1}}\nfence: 'yes'"),
            "z:2:8: fence is yes (must be true or false). Did you mean true?\n");
  EXPECT_EQ(wrong_with("zoo: {a b: {mass: 1}}"),
            "z:1:7: zoo.a b is no name (letters, digits, _ and -, not beginning with a digit)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1}}\ndays: [{}, {hay: 1, oats: 2}]"),
            "z:2:8: days[0] is without a meal (must have exactly one of hay, oats)\n"
            "z:2:21: days[1].oats is given beside hay (must have exactly one of hay, oats). Keep one of them\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1}}\ndays: 3"), "z:2:7: days is 3 (must be a list)\n");
  EXPECT_EQ(wrong_with("zoo: {a: {mass: 1, lges: 4}}\nfnce: true"),
            "z:1:20: zoo.a.lges is unknown (no key of zoo.a). Did you mean legs?\n"
            "z:2:1: fnce is unknown (no key of the file). Did you mean fence?\n");
}

TEST(KeyReference, ShowsTheKeysUnderAPrefix) {
  EXPECT_EQ(key_reference(animals(), "fence"),
            "key    value          default  meaning\n\nfence  true or false  true     Is there one?\n");
  EXPECT_EQ(key_reference(animals(), "nothing"), "");
  const std::string all = key_reference(animals());
  for (const Key& key : animals().keys()) EXPECT_THAT(all, testing::HasSubstr("\n" + key.path + " "));
}

TEST(Range, SaysInWordsWhatItHolds) {
  EXPECT_EQ(positive.words(), "positive");
  EXPECT_FALSE(positive.holds(0));
  EXPECT_TRUE(not_negative.holds(0));
  const Range half_open{.low = 0, .high = 1, .high_open = true};
  EXPECT_EQ(half_open.words(), "at least 0 and below 1");
  EXPECT_TRUE(half_open.holds(0));
  EXPECT_FALSE(half_open.holds(1));
}

}  // namespace

}  // namespace scree
