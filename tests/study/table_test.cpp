// The table and what is drawn from it.
#include "tools/study/table.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>

#include "engine/base/check.h"
#include "tests/temp_folder.h"
#include "tools/study/ensembles.h"
#include "tools/study/first_time.h"
#include "tools/study/forecast.h"
#include "tools/study/plot.h"
#include "tools/study/summary_value.h"

namespace scree::study {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Table sample() {
  return {{{"run", {1, 2, 3}},
           {"beta", {1, 100, 10}},
           {"packing", {}, {"a", "a", "b"}, true},
           {"hot", {0.1, missing, 1e-300}},
           {"reason", {}, {"", "said \"no\", twice", "two\nlines"}, true}}};
}

TEST(StudyTable, QuotesWhatCsvAsksFor) {
  EXPECT_EQ(to_csv(sample()),
            "run,beta,packing,hot,reason\n1,1,a,0.1,\n2,100,a,,\"said \"\"no\"\", twice\"\n3,10,b,1e-300,\"two\nlines\"\n");
}

TEST(StudyTable, ComesBackFromHdf5ToTheBit) {
  const auto file = test::temp_folder() / "table.h5";
  write_hdf5(sample(), file);
  const Table table = read_table(file);
  EXPECT_EQ(to_csv(table), to_csv(sample()));
  EXPECT_EQ(table.find("hot")->numbers[2], 1e-300);
  std::filesystem::remove(file);
  EXPECT_THROW(read_table(file), InputError);
}

// None of them ends the program: what is read all the same has as many cells in each column.
TEST(StudyTable, WithAFlippedBitIsRefusedOrStillATable) {
  const auto file = test::temp_folder() / "table.h5";
  write_hdf5(sample(), file);
  std::ostringstream whole;
  whole << std::ifstream(file, std::ios::binary).rdbuf();
  std::size_t refused = 0;
  for (std::size_t at = 0; at < whole.str().size(); at += 3) {
    std::string damaged = whole.str();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    std::ofstream(file, std::ios::binary) << damaged;
    try {
      EXPECT_FALSE(to_csv(read_table(file)).empty()) << at;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100U);
}

// Fisher (1925), The arrangement's yields: any table of t gives 2.776 for four degrees of freedom.
TEST(StudyEnsembles, GiveMeanDeviationAndTheIntervalOfStudentsT) {
  const Statistics s = statistics_of({1, 2, missing, 3, 4, 5});
  EXPECT_EQ(s.count, 5u);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(2.5));
  EXPECT_NEAR(s.high - s.mean, 2.776445 * std::sqrt(2.5 / 5), 1e-6);
  EXPECT_DOUBLE_EQ(s.high - s.mean, s.mean - s.low);
}

TEST(StudyEnsembles, KnowNoSpreadOfOneValueAndNoMeanOfNone) {
  const Statistics one = statistics_of({missing, 7});
  EXPECT_EQ(one.mean, 7);
  EXPECT_TRUE(std::isnan(one.deviation) && std::isnan(one.low) && std::isnan(one.high));
  EXPECT_EQ(statistics_of({missing}).count, 0u);
  EXPECT_TRUE(std::isnan(statistics_of({}).mean));
}

TEST(StudyEnsembles, LeaveOutMembersThatAreNotSound) {
  Study study;
  study.factors.push_back({{"beta"}, {}, {}, {}});
  Report hot;
  hot.column = hot.path = "hot";
  study.reports.push_back(hot);
  const Table runs{{{"point", {1, 1, 1, 2, 2, 2}},
                    {"beta", {1, 1, 1, 5, 5, 5}},
                    {"hot", {10, 20, 1000, 7, 7, 10}},
                    {"status", {}, {"complete", "complete", "not_converged", "complete", "complete", "complete"}, true}}};
  const Table table = ensembles_of(study, runs);
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_THAT(table.find("beta")->numbers, testing::ElementsAre(1, 5));
  EXPECT_THAT(table.find("hot.count")->numbers, testing::ElementsAre(2, 3));
  EXPECT_THAT(table.find("hot.mean")->numbers, testing::ElementsAre(15, 8));
}

TEST(StudyEnsembles, GiveNoMeanTimeWhereAMemberNeverGetsThere) {
  Study study;
  study.factors.push_back({{"beta"}, {}, {}, {}});
  Report time;
  time.column = "time";
  time.probe = "inside";
  study.reports.push_back(time);
  const Table runs{{{"point", {1, 1, 1, 2, 2, 2}},
                    {"beta", {1, 1, 1, 5, 5, 5}},
                    {"time", {10, missing, 20, 7, missing, 9}},
                    {"status", {}, {"complete", "complete", "complete", "complete", "not_converged", "complete"}, true}}};
  const Table table = ensembles_of(study, runs);
  EXPECT_THAT(table.find("time.count")->numbers, testing::ElementsAre(2, 2));
  EXPECT_TRUE(std::isnan(table.find("time.mean")->numbers[0]) && std::isnan(table.find("time.low")->numbers[0]));
  EXPECT_EQ(table.find("time.mean")->numbers[1], 8);
}

TEST(StudyPlot, MakesALineOfEachSeriesInTheOrderOfX) {
  PlotArguments arguments;
  arguments.x = "beta";
  arguments.y = "run";
  arguments.series = "packing";
  const auto series = series_of(sample(), arguments);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[0].name, "packing a");
  EXPECT_EQ(series[0].marks[1].x, 100);
  arguments.y = "hot";
  EXPECT_EQ(series_of(sample(), arguments)[0].marks.size(), 1u) << "a missing figure is no point";
}

TEST(StudyPlot, NamesTheColumnThatWasProbablyMeant) {
  PlotArguments arguments;
  arguments.x = "btea";
  arguments.y = "hot";
  EXPECT_THAT([&] { series_of(sample(), arguments); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("Did you mean beta?")));
  arguments.x = "packing";
  EXPECT_THAT([&] { series_of(sample(), arguments); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("must be a column of numbers")));
}

TEST(SummaryValue, IsFoundByNamesNumbersAndNamesWithDots) {
  const auto summary = nlohmann::json::parse(R"({
    "heat": {"ledger": {"by_boundary": {"temperature of plate.top": 3}}, "probes": {"in": {"temperature": 350.5}}},
    "stages": [{"name": "mesh", "wall_seconds": 1}, {"name": "heat", "wall_seconds": 2}],
    "along": [7, 8]})");
  EXPECT_EQ(value_at(summary, "heat.probes.in.temperature"), 350.5);
  EXPECT_EQ(value_at(summary, "heat.ledger.by_boundary.temperature of plate.top"), 3);
  EXPECT_EQ(value_at(summary, "stages.heat.wall_seconds"), 2);
  EXPECT_EQ(value_at(summary, "along.1"), 8);
  EXPECT_TRUE(value_at(summary, "along.2").is_null());
  EXPECT_TRUE(value_at(summary, "heat.probes.out").is_null());
  for (const std::string& path : leaves(summary)) EXPECT_FALSE(value_at(summary, path).is_null()) << path;
}

TEST(FirstTime, IsFoundBetweenSamplesRisingOrFalling) {
  const std::vector<double> times{0, 10, 20, 30}, values{300, 320, 310, 330};
  EXPECT_EQ(first_time_at(times, values, 315), 7.5);
  EXPECT_EQ(first_time_at(times, values, 300), 0);
  EXPECT_EQ(first_time_at(times, values, 325), 27.5);
  EXPECT_EQ(first_time_at(times, {330, 320, 325, 300}, 325), 5);
  EXPECT_EQ(first_time_at(times, values, 331), std::nullopt);
}

TEST(Forecast, CountsARunThatSettlesForAsLongAsSuchRunsTake) {
  Forecast forecast;
  for (int i = 0; i < 12; ++i) forecast.expect(i < 2);
  EXPECT_EQ(forecast.done_part(), 0);
  forecast.count(true, 90);
  forecast.count(false, 2);
  EXPECT_DOUBLE_EQ(forecast.done_part(), 92.0 / 200);
}

}  // namespace
}  // namespace scree::study
