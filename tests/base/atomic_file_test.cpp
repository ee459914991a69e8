#include "engine/base/atomic_file.h"

#include <fstream>
#include <sstream>

#include <sys/stat.h>

#include <gmock/gmock.h>

#include "engine/base/check.h"
#include "tests/temp_folder.h"

namespace scree {
namespace {

using testing::HasSubstr;

class AtomicFiles : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  static std::string contents(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  // What is said when this file is written; empty if it could be.
  static std::string refusal(const std::filesystem::path& file) {
    try {
      write_text(file, "new");
    } catch (const RunError& error) {
      return error.what();
    }
    return {};
  }

 private:
  test::TempFolder folder_;
};

TEST_F(AtomicFiles, AppearWholeUnderTheirNameAndLeaveNothingBeside) {
  write_text(file("a"), "old");
  write_text(file("a"), "new");
  EXPECT_EQ(contents(file("a")), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 1);
}

TEST_F(AtomicFiles, KeepTheOldOneIfTheNewOneFails) {
  write_text(file("a"), "old");
  const auto fails = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw RunError("no more");
  };
  EXPECT_THROW(write_atomically(file("a"), fails), RunError);
  EXPECT_EQ(contents(file("a")), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 1);
}

TEST_F(AtomicFiles, GoThroughALinkToWhatItPointsTo) {
  std::filesystem::create_directory(file("other"));
  std::filesystem::create_symlink("other/there", file("link"));
  write_text(file("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(file("link")));
  EXPECT_EQ(contents(file("other/there")), "new");
}

TEST_F(AtomicFiles, TakeNoPlaceOfADeviceAPipeOrAFolder) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(file("folder"));
  for (const std::filesystem::path& place : {std::filesystem::path("/dev/null"), file("pipe"), file("folder")}) {
    EXPECT_THAT(refusal(place), HasSubstr("could not be written (it is no regular file). Choose another place"));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(file("pipe")));
}

TEST_F(AtomicFiles, TellWhyTheyCannotBeWritten) {
  EXPECT_THAT(refusal(file("none/a")), HasSubstr("could not be written (No such file or directory). Choose another place"));
  EXPECT_THAT(not_written("a", std::make_error_code(std::errc::no_space_on_device)), HasSubstr("Free some space"));
}

}  // namespace
}  // namespace scree
