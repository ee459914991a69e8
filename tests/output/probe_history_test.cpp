#include "engine/output/probe_history.h"

#include <gmock/gmock.h>

#include "engine/base/check.h"
#include "engine/output/probe_table.h"
#include "tests/output/support.h"

namespace scree::output {
namespace {

using testing::ElementsAre;

class ProbeHistoryTest : public ::testing::Test {
 protected:
  TempFolder folder_;
  std::filesystem::path file_ = folder_.path() / "probes.csv";
};

TEST_F(ProbeHistoryTest, IsWhatTheTableWasGivenNamesWithCommasAndQuotesIncluded) {
  ProbeTable table(file_, {"a comment"}, {"low", "a,b", "the \"top\""});
  table.append(0, {298.15, 1, 2});
  table.append(600, {1.0 / 3, 3, 4});
  const ProbeHistory history = read_probe_history(file_);
  EXPECT_THAT(history.times, ElementsAre(0, 600));
  EXPECT_THAT(history.values.at("low"), ElementsAre(298.15, 1.0 / 3));
  EXPECT_THAT(history.values.at("a,b"), ElementsAre(1, 3));
  EXPECT_THAT(history.values.at("the \"top\""), ElementsAre(2, 4));
  EXPECT_TRUE(history.exact.empty());
  EXPECT_FALSE(largest_error(history));
}

TEST_F(ProbeHistoryTest, LargestErrorLeavesTheStartOut) {
  ProbeTable table(file_, {}, {"low", exact_column("low")});
  table.append(0, {300, 400});
  table.append(1, {310, 309});
  table.append(2, {320, 322.5});
  EXPECT_DOUBLE_EQ(*largest_error(read_probe_history(file_)), 2.5);
}

TEST_F(ProbeHistoryTest, OfASteadyStateIsItsOnlyRow) {
  ProbeTable table(file_, {}, {"low", exact_column("low")});
  table.append(0, {300, 300.5});
  EXPECT_DOUBLE_EQ(*largest_error(read_probe_history(file_)), 0.5);
}

TEST_F(ProbeHistoryTest, WithoutATableIsAnInputError) {
  EXPECT_THROW(read_probe_history(file_), InputError);
}

}  // namespace
}  // namespace scree::output
