#include "engine/base/plain_path.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/temp_folder.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

TEST(PlainPath, NamesTheSameFileBehindALinkToAFolder) {
  const fs::path folder = test::temp_folder() / "plain_path";
  fs::remove_all(folder);
  fs::create_directories(folder / "data/deep");
  fs::create_directories(folder / "work");
  fs::create_directory_symlink(folder / "data/deep", folder / "work/link");
  for (const char* file : {"data/oven.csv", "work/oven.csv"}) std::ofstream(folder / file) << file;
  EXPECT_TRUE(fs::equivalent(plain_path(folder / "work/link/../oven.csv"), folder / "data/oven.csv"));
  EXPECT_EQ(plain_path(folder / "data/deep/../oven.csv"), folder / "data/oven.csv");
  EXPECT_EQ(plain_path("a/./b/../not there"), "a/not there");
}

}  // namespace
}  // namespace scree
