#include "engine/base/made_meanwhile.h"

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(MadeMeanwhile, IsMadeOnceByAThreadOfItsOwnWithoutHelpersOrByTheOneThatAsks) {
  const int before = threads_in_use();
  for (const int threads : {1, 3}) {
    use_threads(threads);
    int times = 0, helped_by = 0;
    std::thread::id maker;
    const MadeMeanwhile<int> meanwhile([&] {
      maker = std::this_thread::get_id();
      helped_by = threads_in_use();
      return ++times;
    });
    EXPECT_EQ(meanwhile.get(), 1);
    EXPECT_EQ(meanwhile.get(), 1);
    EXPECT_FALSE(meanwhile.under_way());
    EXPECT_EQ(maker == std::this_thread::get_id(), threads == 1);
    EXPECT_EQ(helped_by, 1);
    EXPECT_EQ(threads_in_use(), threads);
  }
  use_threads(before);
}

TEST(MadeMeanwhile, ThrowsWhatMakingItThrewWheneverItIsAskedFor) {
  const int before = threads_in_use();
  for (const int threads : {1, 2}) {
    use_threads(threads);
    const MadeMeanwhile<int> meanwhile([]() -> int { throw std::runtime_error("no memory"); });
    EXPECT_THROW(static_cast<void>(meanwhile.get()), std::runtime_error);
    EXPECT_THROW(static_cast<void>(meanwhile.get()), std::runtime_error);
  }
  use_threads(before);
}

TEST(MadeMeanwhile, IsThereIfItWasMadeBefore) {
  const MadeMeanwhile<std::string> made(std::string("made"));
  EXPECT_FALSE(made.under_way());
  EXPECT_EQ(made.get(), "made");
}

}  // namespace
}  // namespace scree
