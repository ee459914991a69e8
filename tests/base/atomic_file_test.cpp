#include "engine/base/atomic_file.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <sys/stat.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "engine/base/check.h"
#include "engine/base/files_together.h"
#include "engine/base/page_buffer.h"
#include "tests/file_limit.h"
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

TEST_F(AtomicFiles, WrittenTogetherHaveTheirNamesWhenAllAreOnTheDisk) {
  write_text(file("a"), "old");
  FilesTogether files;
  {
    const FilesTogether::Scope scope(files);
    write_text(file("a"), "new");
    write_text(file("b"), "first");
    write_text(file("c"), "its own");
    write_text(file("b"), "second");
  }
  EXPECT_EQ(contents(file("a")), "old");
  EXPECT_FALSE(std::filesystem::exists(file("b")));
  files.publish();
  EXPECT_EQ(contents(file("a")), "new");
  EXPECT_EQ(contents(file("b")), "second");
  EXPECT_EQ(contents(file("c")), "its own");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 3);
}

TEST_F(AtomicFiles, WrittenTogetherKeepTheEarlierOneIfTheNextFails) {
  FilesTogether files;
  const FilesTogether::Scope scope(files);
  const auto fails = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw RunError("no more");
  };
  write_text(file("a"), "earlier");
  EXPECT_THROW(write_atomically(file("a"), fails), RunError);
  EXPECT_THROW(write_atomically(file("a"), fails), RunError);
  files.publish();
  EXPECT_EQ(contents(file("a")), "earlier");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 1);
}

TEST_F(AtomicFiles, WrittenTogetherMayWaitForOthers) {
  FilesTogether first, last;
  {
    const FilesTogether::Scope scope(first);
    write_text(file("a"), "first");
  }
  EXPECT_TRUE(first.since());
  first.pass_on(last);
  EXPECT_FALSE(first.since());
  EXPECT_TRUE(last.since());
  first.publish();
  EXPECT_FALSE(std::filesystem::exists(file("a")));
  last.publish();
  EXPECT_FALSE(last.since());
  EXPECT_EQ(contents(file("a")), "first");
}

TEST_F(AtomicFiles, WrittenTogetherAreNamedEvenIfOneAfterThemFails) {
  const auto write_two = [&] {
    FilesTogether files;
    const FilesTogether::Scope scope(files);
    write_text(file("a"), "whole");
    write_text(file("nowhere") / "b", "never");
  };
  EXPECT_THROW(write_two(), RunError);
  EXPECT_EQ(contents(file("a")), "whole");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 1);
}

TEST_F(AtomicFiles, WrittenTogetherAreNotNamedBehindOneThatCannotBe) {
  FilesTogether files;
  const FilesTogether::Scope scope(files);
  write_text(file("a"), "first");
  write_text(file("b"), "in the way of a folder");
  write_text(file("c"), "names the one before");
  std::filesystem::create_directories(file("b") / "full");
  EXPECT_THROW(files.publish(), RunError);
  EXPECT_EQ(contents(file("a")), "first");
  EXPECT_FALSE(std::filesystem::exists(file("c")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 2);
  write_text(file("d"), "later");
  write_unflushed(file("e"), "at once");
  EXPECT_EQ(contents(file("e")), "at once");
  EXPECT_FALSE(std::filesystem::exists(file("d")));
  files.publish();
  EXPECT_EQ(contents(file("d")), "later");
}

TEST_F(AtomicFiles, TakeNoPlaceOfADeviceAPipeOrAFolder) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(file("folder"));
  for (const std::filesystem::path& place : {std::filesystem::path("/dev/null"), file("pipe"), file("folder")}) {
    EXPECT_THAT(refusal(place), HasSubstr("could not be written (it is no regular file). Choose another place"));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(file("pipe")));
}

// The parts as they stand in memory, one behind the other, are what must be found, whichever way they go.
TEST_F(AtomicFiles, HoldTheirPartsOneBehindTheOtherOnEitherWay) {
  PageBuffer first, second;
  for (int i = 0; i < 100'000; ++i) first.append(fmt::format("{} ", i));
  first.fill_page(0, '.');
  second.append("some more");
  second.fill_page(4, '.');
  second.append("end\n");
  const std::string whole = std::string(first.view()) + std::string(second.view());
  EXPECT_EQ(whole.size() % PageBuffer::page, 0u);
  for (const Way way : {Way::cached, Way::direct}) {
    write_atomically(file("pages"), std::array{first.view(), second.view()}, way);
    EXPECT_EQ(contents(file("pages")), whole);
  }
}

TEST_F(AtomicFiles, TakePartsThatAreNoWholePagesOnEitherWay) {
  PageBuffer pages;
  pages.fill_page(1, 'p');
  pages.append("p");
  const std::string some(10'000, 's');
  const std::array<std::string_view, 5> parts{"", pages.view(), "odd", std::string_view(some).substr(1), pages.view()};
  std::string whole;
  for (const std::string_view part : parts) whole += part;
  for (const Way way : {Way::cached, Way::direct}) {
    write_atomically(file("odd"), parts, way);
    EXPECT_EQ(contents(file("odd")), whole);
  }
}

// /dev/shm is kept in memory: there is no disk to write to directly.
TEST_F(AtomicFiles, AreWrittenWhereThereIsNoDisk) {
  std::string name = "/dev/shm/scree-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) GTEST_SKIP() << "no /dev/shm";
  PageBuffer pages;
  pages.fill_page(1, 'p');
  pages.append("p");
  write_atomically(name + "/a", std::array{pages.view()}, Way::direct);
  EXPECT_EQ(contents(name + "/a"), pages.view());
  std::filesystem::remove_all(name);
}

// 5000 is within a page, where writing directly cannot end.
TEST_F(AtomicFiles, TellOfAFullDiskAndLeaveNothingOnEitherWay) {
  PageBuffer pages;
  for (int i = 0; i < 10; ++i) pages.append(std::string(PageBuffer::page, 'p'));
  for (const Way way : {Way::cached, Way::direct}) {
    for (const std::size_t bytes : {std::size_t{0}, 2 * PageBuffer::page, std::size_t{5000}, pages.size() - 1}) {
      const test::FileLimit limit(bytes);
      EXPECT_THAT([&] { write_atomically(file("a"), std::array{pages.view()}, way); },
                  testing::ThrowsMessage<RunError>(HasSubstr("could not be written (File too large)")));
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(file("")));
}

TEST_F(AtomicFiles, TellWhyTheyCannotBeWritten) {
  EXPECT_THAT(refusal(file("none/a")), HasSubstr("could not be written (No such file or directory). Choose another place"));
  EXPECT_THAT(not_written("a", std::make_error_code(std::errc::no_space_on_device)), HasSubstr("Free some space"));
}

}  // namespace
}  // namespace scree
