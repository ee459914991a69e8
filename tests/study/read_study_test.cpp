// What a study file may say, and what is said of one that is wrong.
#include "tests/study/study_text.h"

#include <map>
#include <set>

#include <gmock/gmock.h>

#include "tools/study/scene_key.h"

namespace scree::study {
namespace {

using test::study_of;
using test::wrong_with;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ReadStudy, MakesEveryCombinationTheLastKeyFastest) {
  const auto runs = plan(study_of(R"(
scene: scene.yaml
vary:
  - {key: contact.stiffness_factor, values: [1, 10]}
  - {key: heat.initial, values: [300 K, 20 degC, 310]}
report: [heat.time_error]
)"));
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_THAT(runs[1].overrides, testing::ElementsAre("contact.stiffness_factor=1", "heat.initial=20 degC"));
  EXPECT_EQ(runs[1].point.levels[1].number, 293.15);
  EXPECT_THAT(runs[5].overrides, testing::ElementsAre("contact.stiffness_factor=10", "heat.initial=310"));
}

TEST(ReadStudy, TakesFilesThatAValueNamesHoweverDeepInItFromItsOwnFolder) {
  const Study study = study_of(R"(
scene: scene.yaml
set:
  - "heat.initial={block: {table: warm.csv}, floor: 20 degC, other: null}"
  - "heat.boundaries=[{body: floor, temperature: {table: ../t.csv}}, {body: block, temperature: {table: [[0, 300], [9, 310]]}}]"
vary:
  - {key: materials.rock.conductivity, values: ["{table: k.csv}", "{table: /k.csv}", "{expression: 1 + T, unit: W/m/K}", "{table"]}
report: [heat.time_error]
)");
  const auto folder = std::filesystem::absolute(study.file).parent_path();
  const auto quoted = [](const std::filesystem::path& path) { return '"' + path.string() + '"'; };
  EXPECT_EQ(study.changes[0].assignment,
            "heat.initial={\"block\": {\"table\": " + quoted(folder / "warm.csv") + "}, \"floor\": \"20 degC\", \"other\": ~}");
  EXPECT_EQ(study.changes[1].assignment,
            "heat.boundaries=[{\"body\": \"floor\", \"temperature\": {\"table\": " + quoted(folder.parent_path() / "t.csv") +
                "}}, {\"body\": \"block\", \"temperature\": {\"table\": [[\"0\", \"300\"], [\"9\", \"310\"]]}}]");
  const std::vector<Level>& levels = study.factors[0].levels;
  EXPECT_EQ(levels[0].text, "{\"table\": " + quoted(folder / "k.csv") + "}");
  EXPECT_EQ(levels[1].text, "{\"table\": \"/k.csv\"}");
  EXPECT_EQ(levels[2].text, "{expression: 1 + T, unit: W/m/K}");
  EXPECT_EQ(levels[3].text, "{table");
}

TEST(ReadStudy, VariesOneNumberOfAVector) {
  const auto runs = plan(study_of(R"(
scene: scene.yaml
set: ["bodies.plate.box.size.0=2 m"]
vary: [{key: "bodies.block.box.size[2]", range: {from: 10 cm, to: 20 cm, points: 2}}]
report: [heat.time_error]
)"));
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[1].point.levels[0].number, 0.2);
  EXPECT_THAT(runs[1].overrides,
              testing::ElementsAre("bodies.plate.box.size.0=2 m", testing::StartsWith("bodies.block.box.size[2]=")));
  EXPECT_FALSE(scene_path("bodies.block.box.size[2][0]"));
  EXPECT_FALSE(scene_path("contact.stiffness_factor[0]"));
}

TEST(ReadStudy, SpacesARangeByDifferencesOrByRatios) {
  const Study study = study_of(R"(
scene: scene.yaml
vary:
  - {key: contact.stiffness_factor, range: {from: 1, to: 1000, points: 4, spacing: log}}
  - {key: bodies.block.mesh_size, range: {from: 10 cm, to: 20 cm, points: 3}}
report: [heat.time_error]
)");
  const double factors[] = {1, 10, 100, 1000};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(*study.factors[0].levels[i].number, factors[i]);
  const double sizes[] = {0.1, 0.15, 0.2};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(*study.factors[1].levels[i].number, sizes[i]);
  EXPECT_EQ(study.factors[1].levels[2].text, "0.2 m");
}

TEST(ReadStudy, PutsOnePointOfALatinHypercubeIntoEveryLayerOfEveryKey) {
  const Study study = study_of(R"(
scene: scene.yaml
vary:
  - {key: contact.stiffness_factor, range: {from: 1, to: 1000, spacing: log}}
  - {key: heat.initial, range: {from: 300 K, to: 400 K}}
latin_hypercube: {points: 20, seed: 7}
report: [heat.time_error]
)");
  std::vector<int> by_ratio(20), by_difference(20);
  const auto points = points_of(study);
  ASSERT_EQ(points.size(), 20u);
  for (const Point& point : points) {
    ++by_ratio.at(static_cast<std::size_t>(20 * std::log10(*point.levels[0].number) / 3));
    ++by_difference.at(static_cast<std::size_t>((*point.levels[1].number - 300) / 5));
  }
  EXPECT_THAT(by_ratio, testing::Each(1));
  EXPECT_THAT(by_difference, testing::Each(1));
  Study other = study;
  other.hypercube->seed = 8;
  EXPECT_NE(points_of(other)[0].levels[0].text, points[0].levels[0].text);
  EXPECT_EQ(points_of(study)[0].levels[0].text, points[0].levels[0].text);
}

TEST(ReadStudy, DrawsEachIntegerOfARangeAsOftenAsTheOthers) {
  const Study study = study_of(R"(
scene: scene.yaml
vary: [{key: settle.iterations, range: {from: 78, to: 80}}, {key: heat.initial, range: {from: 300 K, to: 400 K}}]
latin_hypercube: {points: 60}
report: [heat.time_error]
)");
  std::map<std::string, int> drawn;
  for (const Point& point : points_of(study)) ++drawn[point.levels[0].text];
  EXPECT_THAT(drawn, testing::ElementsAre(testing::Pair("78", 20), testing::Pair("79", 20), testing::Pair("80", 20)));
}

TEST(ReadStudy, MakesEqualPointsOfALatinHypercubeOnce) {
  const Study study = study_of(R"(
scene: scene.yaml
vary: [{key: settle.iterations, range: {from: 78, to: 80}}, {key: heat.until, values: [1 h, 2 h]}]
latin_hypercube: {points: 60}
ensemble: {key: settle.seed, members: 2}
report: [heat.time_error]
)");
  std::set<std::string> different;
  const auto points = points_of(study);
  for (const Point& point : points) different.insert(point.levels[0].text + point.levels[1].text + point.levels[2].text);
  EXPECT_EQ(different.size(), points.size());
  EXPECT_EQ(points.size(), 12u) << "60 points miss none of 3 x 2";
  EXPECT_EQ(points.back().number, 5u);
}

TEST(ReadStudy, RepeatsEveryPointForAnEnsembleAndLetsHeatsShareTheirPacking) {
  const auto runs = plan(study_of(R"(
scene: scene.yaml
vary: [{key: contact.stiffness_factor, values: [1, 10]}]
ensemble: {key: settle.seed, members: 3}
report: [heat.time_error]
)"));
  ASSERT_EQ(runs.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(runs[i].packing, runs[i + 3].packing) << "the same seed";
    EXPECT_NE(runs[i].packing, runs[(i + 1) % 3].packing) << "another seed";
    EXPECT_NE(runs[i].directory, runs[i + 3].directory);
  }
  EXPECT_EQ(runs[4].point.number, 1u);
}

TEST(ReadStudy, LetsAPackingChangeWithAllItDependsOnAndNothingElse) {
  const auto packing = [](const std::string& key, const std::string& value) {
    return plan(study_of("scene: scene.yaml\nvary: [{key: " + key + ", values: [" + value + "]}]\nreport: [blocks]\n"))
        .front()
        .packing;
  };
  const std::string as_it_is = packing("heat.until", "1 h");
  EXPECT_EQ(packing("materials.ore.conductivity", "9"), as_it_is);
  EXPECT_EQ(packing("output.every", "2 h"), as_it_is);
  EXPECT_NE(packing("materials.ore.friction", "0.6"), as_it_is);
  EXPECT_NE(packing("bodies.block.mesh_size", "0.1"), as_it_is);
  EXPECT_NE(packing("settle.step", "1 ms"), as_it_is);
}

TEST(ReadStudy, SaysWhereInTheStudyAValueThatDoesNotSuitTheSceneStands) {
  EXPECT_THAT(wrong_with("scene: scene.yaml\n"
                         "vary:\n"
                         "  - {key: contact.stiffness_factor, values: [10, -3]}\n"
                         "report: [heat.time_error]\n"),
              StartsWith("s.yaml:3:50: contact.stiffness_factor is -3 (must be not negative). Did you mean 3?"));
  EXPECT_THAT(wrong_with("scene: scene.yaml\n"
                         "set: [heat.until=1 h, heat.tolerance=2 m]\n"
                         "vary: [{key: contact.stiffness_factor, values: [10]}]\n"
                         "report: [heat.time_error]\n"),
              StartsWith("s.yaml:2:23: heat.tolerance is 2 m (must be"));
}

TEST(ReadStudy, NamesTheKeyThatWasProbablyMeant) {
  const std::string rest = "\nreport: [heat.time_error]\n";
  EXPECT_THAT(wrong_with("scene: scene.yaml\nvary: [{key: contact.stifness_factor, values: [1]}]" + rest),
              HasSubstr("s.yaml:2:14: vary[0].key is contact.stifness_factor (must be the path of a key of the scene). Did you "
                        "mean contact.stiffness_factor?"));
  EXPECT_THAT(wrong_with("scene: scene.yaml\nvary: [{key: heat.until, value: [1 h]}]" + rest),
              HasSubstr("Did you mean values?"));
  EXPECT_THAT(wrong_with("scene: scene.yaml\nset: [heat.untill=1 h]\nvary: [{key: heat.until, values: [1 h]}]" + rest),
              HasSubstr("s.yaml:2:7: set[0] is heat.untill=1 h (must be KEY=VALUE"));
  EXPECT_THAT(wrong_with("scene: scne.yaml\nvary: [{key: heat.until, values: [1 h]}]" + rest),
              HasSubstr("s.yaml:1:8: scene is scne.yaml (must be a scene file that exists)"));
}

TEST(ReadStudy, RefusesAChangeThatTakesAwayAnEarlierOne) {
  const auto with = [](const std::string& set) {
    return wrong_with("scene: scene.yaml\nset:\n" + set +
                      "vary: [{key: contact.stiffness_factor, values: [1, 2]}]\nreport: [blocks]\n");
  };
  EXPECT_EQ(
      with("  - heat.until=2 h\n  - heat.until=3 h\n"),
      "s.yaml:4:5: set[1] is heat.until=3 h (must not give another value to heat.until=2 h, which is set before). Take one "
      "of the two out");
  EXPECT_THAT(with("  - heat.boundaries[0].temperature=390\n  - heat.boundaries.0.temperature=380\n"),
              HasSubstr("s.yaml:4:5: set[1] is heat.boundaries.0.temperature=380"));
  EXPECT_THAT(with("  - settle.limit=4 s\n  - \"settle={seed: 1}\"\n"), HasSubstr("must not take away settle.limit=4 s"));
  EXPECT_EQ(with("  - \"settle={seed: 1}\"\n  - settle.limit=4 s\n"), "accepted");
}

TEST(ReadStudy, RefusesAValueThatMakesTheRunOfAnother) {
  const auto with = [](const std::string& values) {
    return wrong_with("scene: scene.yaml\nvary:\n  - {key: settle.local_damping, values: [" + values +
                      "]}\n  - {key: heat.until, values: [1 h, 2 h]}\nreport: [blocks]\n");
  };
  EXPECT_EQ(with("\"null\", 0.5"), "accepted");
  EXPECT_EQ(
      with("\"null\", 0.5, 0"),
      "s.yaml:3:55: settle.local_damping is 0 (must make another run than null, which means the same here). Take one out");
}

TEST(ReadStudy, RefusesRangesThatGoNowhere) {
  const auto with = [](const std::string& key, const std::string& range) {
    return wrong_with("scene: scene.yaml\nvary: [{key: " + key + ", range: {" + range + "}}]\nreport: [blocks]\n");
  };
  EXPECT_THAT(with("heat.until", "from: 2 h, to: 1 h, points: 2"), HasSubstr("must be above range.from, 2 h"));
  EXPECT_THAT(with("heat.until", "from: 0 h, to: 1 h, points: 2, spacing: log"), HasSubstr("must be positive where"));
  EXPECT_THAT(with("heat.until", "from: 1 m, to: 1 h, points: 2"), HasSubstr("range.from is 1 m"));
  EXPECT_THAT(with("contact.model", "from: 1, to: 2, points: 2"), HasSubstr("must be values"));
}

TEST(ReadStudy, RefusesFiguresThatTheScenesRunsCannotReport) {
  const auto with = [](const std::string& report) {
    return wrong_with("scene: scene.yaml\nvary: [{key: heat.until, values: [1 h]}]\nreport: [" + report + "]\n");
  };
  EXPECT_EQ(with("heat.probes.top.temperature"), "accepted");
  EXPECT_EQ(with("models.0.name"), "accepted");
  for (const char* name : {"\"\"", "\".\"", "{column: \"\", path: blocks}"}) {
    EXPECT_THAT(with(name), HasSubstr("must be the name of a column")) << name;
  }
  EXPECT_THAT(with("heat.probes.tip.temperature"), HasSubstr("s.yaml:3:10: report is tip (must be a probe of the scene). Did "
                                                             "you mean top?"));
  EXPECT_THAT(with("{column: t, probe: tip, reaches: 350}"), HasSubstr("must be a probe of the scene"));
  EXPECT_THAT(with("{column: t, probe: top}"), HasSubstr("report[0].reaches is missing"));
  EXPECT_EQ(with("{column: t, probe: top, reaches: 350}"), "accepted");
  EXPECT_THAT(wrong_with("scene: scene.yaml\nset: [heat.steady=true, heat.until=null, heat.tolerance=null, output.every=null]\n"
                         "vary: [{key: contact.stiffness_factor, values: [1]}]\n"
                         "report: [{column: t, probe: top, reaches: 350}]\n"),
              HasSubstr("of use only over time, which a steady scene does without). Ask for heat.probes.top.temperature"));
  EXPECT_THAT(with("heet.time_error"), HasSubstr("Did you mean heat?"));
  EXPECT_THAT(with("effective_conductivity.along.0"), HasSubstr("of use only with heat.effective_conductivity"));
  EXPECT_THAT(with("blocks, blocks"), HasSubstr("every column must have a name of its own"));
}

TEST(ReadStudy, RefusesWhatWouldCountDoubleOrNotAtAll) {
  const std::string rest = "\nreport: [blocks]\n";
  EXPECT_THAT(wrong_with("scene: scene.yaml\nvary: [{key: heat.until, values: [1 h, 2 h, 60 min]}]" + rest),
              HasSubstr("s.yaml:2:45: heat.until is 60 min (must not be given twice)"));
  EXPECT_THAT(wrong_with("scene: scene.yaml\nset: [heat.until=3 h]\nvary: [{key: heat.until, values: [1 h, 2 h]}]" + rest),
              HasSubstr("heat.until is varied (must not be in set, too: heat.until=3 h)"));
  EXPECT_THAT(wrong_with("scene: scene.yaml\nvary: [{key: bodies.block.box.centre, values: [[0, 0, 1], [0, 0, 2]]}]" + rest),
              testing::Not(HasSubstr("twice")));
}

TEST(ReadStudy, TakesThePathOfAKeyInOneOfItsTwoSpellingsOnly) {
  const auto with = [](const std::string& key) {
    return wrong_with("scene: scene.yaml\nvary: [{key: \"" + key + "\", values: [401]}]\nreport: [blocks]\n");
  };
  for (const char* good : {"heat.boundaries[0].temperature", "heat.boundaries.0.temperature"})
    EXPECT_EQ(with(good), "accepted");
  for (const char* wrong : {"heat.boundaries.[0].temperature", "heat.boundaries[00].temperature",
                            "heat.boundaries.00.temperature", "heat.boundaries[].temperature", "heat.boundaries[x].temperature",
                            "heat.boundaries..0.temperature", "heat.boundaries[0].temprature"}) {
    EXPECT_THAT(with(wrong), AllOf(StartsWith("s.yaml:2:14: vary[0].key is "),
                                   HasSubstr("(must be the path of a key of the scene). Did you mean "
                                             "heat.boundaries[0].temperature?")))
        << wrong;
  }
  EXPECT_THAT(with("bodies.block.mesh_sze"), HasSubstr("Did you mean bodies.block.mesh_size?"));
  EXPECT_THAT(with("bodies.*.mesh_size"), HasSubstr("Did you mean bodies.NAME.mesh_size?"));
  EXPECT_THAT(with("bodies[block].mesh_size"), HasSubstr("Did you mean bodies.NAME.mesh_size?"));
}

TEST(ReadStudy, RefusesKeysThatGiveTheSameValueTwice) {
  const auto with = [](const std::string& one, const std::string& other) {
    return wrong_with("scene: scene.yaml\nreport: [blocks]\nvary:\n  - {key: " + one + ", values: [1]}\n  - {key: " + other +
                      ", values: [1]}\n");
  };
  EXPECT_THAT(with("\"heat.boundaries[0].temperature\"", "heat.boundaries.0.temperature"),
              StartsWith("s.yaml:5:11: heat.boundaries.0.temperature is varied (must not be heat.boundaries[0].temperature, "
                         "which is varied at line 4). Take one of the two out"));
  EXPECT_THAT(with("heat", "heat.until"), HasSubstr("heat.until is varied (must not lie inside heat, which"));
  EXPECT_THAT(with("materials.ore.conductivity", "materials.ore"),
              HasSubstr("materials.ore is varied (must not hold materials.ore.conductivity, which"));
  EXPECT_THAT(with("contact.stiffness_factor, also: [contact.stiffness_factor]", "heat.until"), HasSubstr("s.yaml:4:44: "));
  EXPECT_THAT(wrong_with("scene: scene.yaml\nreport: [blocks]\nset: [settle.seed=4]\nvary: [{key: heat, values: [1]}]\n"
                         "ensemble: {key: settle.seed, members: 2}\n"),
              HasSubstr("s.yaml:5:17: settle.seed is varied (must not be in set, too: settle.seed=4)"));
  EXPECT_EQ(wrong_with("scene: scene.yaml\nreport: [blocks]\nset: [\"heat.boundaries=[{body: plate, temperature: 350}]\"]\n"
                       "vary: [{key: heat.boundaries.0.temperature, values: [400]}]\n"),
            "accepted")
      << "what varies may lie in what was set before";
}

TEST(ReadStudy, RefusesMoreRunsThanAnyoneCouldMakeAndSaysHowMany) {
  const std::string start = "scene: scene.yaml\nreport: [blocks]\nvary:\n";
  std::string factors;
  for (const char* key : {"contact.stiffness_factor", "materials.ore.conductivity"}) {
    factors += std::string("  - {key: ") + key + ", range: {from: 1, to: 2, points: 100000}}\n";
  }
  EXPECT_THAT(wrong_with(start + factors),
              StartsWith("s.yaml:4:3: vary is 10000000000 runs (must be at most 100000 in all). Take fewer values"));
  const std::string hypercube = start + "  - {key: contact.stiffness_factor, range: {from: 1, to: 2}}\n" +
                                "ensemble: {key: settle.seed, members: 1001}\nlatin_hypercube: {points: 100}\n";
  EXPECT_THAT(wrong_with(hypercube), HasSubstr("vary is 100100 runs"));
  EXPECT_THAT(wrong_with("scene: scene.yaml\nreport: [blocks]\nensemble: {key: settle.seed, members: 100001}\n"),
              HasSubstr("ensemble.members is 100001 (must be a whole number, at least 2 and at most 100000)"));
}

TEST(ReadStudy, RefusesAStudyOfNothing) {
  EXPECT_THAT(wrong_with("scene: scene.yaml\nreport: [blocks]\n"), HasSubstr("must have vary, ensemble, or both"));
}

}  // namespace
}  // namespace scree::study
