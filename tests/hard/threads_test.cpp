// No result depends on the number of threads.
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include <gtest/gtest.h>

#include "engine/base/threads.h"
#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

std::string bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Threads, GiveTheSamePackingContactsAndTemperaturesToTheBitHoweverMany) {
  const int before = threads_in_use();
  std::map<int, std::filesystem::path> runs;
  for (const int threads : {1, 3}) {
    use_threads(threads);
    runs[threads] = fresh_directory(fmt::format("threads_{}", threads));
    ASSERT_EQ(run("small_pile", runs[threads], {"heat.until=1 h"}).exit_status, 0);
  }
  use_threads(before);
  for (const char* file : {"probes.csv", "packing.h5", "heat.restart.h5"}) {
    // Not EXPECT_EQ, which would print the files.
    EXPECT_TRUE(bytes(runs[3] / file) == bytes(runs[1] / file)) << file;
  }
}

}  // namespace
}  // namespace scree::test
