#include "engine/output/probe_table.h"

#include <fstream>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/file_limit.h"
#include "tests/output/support.h"

namespace scree::output {
namespace {

class ProbeTableTest : public ::testing::Test {
 protected:
  TempFolder folder_;
  std::filesystem::path file_ = folder_.path() / "probes.csv";
};

TEST_F(ProbeTableTest, HasCommentsThenAHeaderThenARowPerTime) {
  ProbeTable table(file_, {"low: block 3 of rock"}, {"low", "high"});
  table.append(0, {298.15, 298.15});
  table.append(600, {299.25, 1.0 / 3});
  EXPECT_EQ(content(file_), "# low: block 3 of rock\ntime,low,high\n0,298.15,298.15\n600,299.25,0.3333333333333333\n");
}

TEST_F(ProbeTableTest, ANameWithACommaIsQuoted) {
  const ProbeTable table(file_, {}, {"a,b", "the \"top\""});
  EXPECT_EQ(content(file_), "time,\"a,b\",\"the \"\"top\"\"\"\n");
}

TEST_F(ProbeTableTest, AResumedRunKeepsTheRowsUpToItsTime) {
  {
    ProbeTable table(file_, {"low"}, {"low"});
    for (const double time : {0.0, 0.1, 0.2, 0.3}) table.append(time, {1 + time});
  }
  ProbeTable table(file_, {"low"}, {"low"}, 0.1);
  table.append(0.15, {7});
  EXPECT_EQ(content(file_), "# low\ntime,low\n0,1\n0.1,1.1\n0.15,7\n");
}

TEST_F(ProbeTableTest, AResumedRunDropsAHalfWrittenRow) {
  std::ofstream(file_) << "time,low\n0,1\n0.1,29\n0.2,";
  const ProbeTable table(file_, {}, {"low"}, 0.1);
  EXPECT_EQ(content(file_), "time,low\n0,1\n0.1,29\n");
}

TEST_F(ProbeTableTest, ATableThatWasCutOrIsAnotherIsNotGoneOnWith) {
  for (const char* damaged : {"", "time,low\n0,1\n0.1,29", "time,low\n0,1\n0.2,3\n", "0,1\n0.1,2\n", "time,high\n0,1\n0.1,2\n",
                              "\x01junk\n0.1,2\n"}) {
    std::ofstream(file_) << damaged;
    EXPECT_THROW(ProbeTable(file_, {}, {"low"}, 0.1), InputError) << damaged;
    EXPECT_EQ(content(file_), damaged);
  }
}

TEST_F(ProbeTableTest, ResumingWithoutATableFails) {
  EXPECT_THROW(ProbeTable(file_, {}, {"low"}, 0.1), InputError);
}

TEST_F(ProbeTableTest, AFullDiskLeavesTheTableAsItWas) {
  ProbeTable table(file_, {}, {"low"});
  table.append(0, {1});
  const std::string before = content(file_);
  {
    const test::FileLimit limit(before.size() + 5);
    EXPECT_THROW(table.append(600, {299.123456789}), RunError);
  }
  EXPECT_EQ(content(file_), before);
}

}  // namespace
}  // namespace scree::output
