#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <thread>

#include "base/move_file.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/whole_file.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using testing::text_of;

TEST(WholeFile, OfTwoThatWriteItOneIsWhole) {
  const testing::TemporaryFile place("");
  const auto write = [&](char letter) {
    try {
      write_whole_file(place.path(), [&](std::ostream& out) {
        for (int i = 0; i < 2000; ++i) out << std::string(100, letter) << std::flush;
      });
    } catch (const ConfigError&) {  // the other one was faster, which is told
    }
  };
  for (int round = 0; round < 5; ++round) {
    std::thread other([&] { write('b'); });
    write('a');
    other.join();
    const std::string text = text_of(place.path());
    EXPECT_EQ(text, std::string(200000, text.at(0)));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(place.folder()), {}), 1) << "nothing is left aside";
}

TEST(WholeFile, LeavesWhatIsThereUntilItIsWhole) {
  const testing::TemporaryFile place("old");
  const auto fails = [](std::ostream& out) {
    out << "half";
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(write_whole_file(place.path(), fails), std::runtime_error);
  EXPECT_EQ(text_of(place.path()), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(place.folder()), {}), 1);
}

TEST(WholeFile, LeavesWhatCameMeanwhile) {
  const testing::TemporaryFile place("");
  const std::string path = (place.folder() / "new").string();
  const auto write = [&](std::ostream& out) {
    out << "new";
    std::ofstream(path) << "precious";
  };
  EXPECT_THROW(write_whole_file(path, write, ""), ConfigError);
  EXPECT_EQ(text_of(path), "precious");
}

TEST(WholeFile, ReplacesNoLink) {
  const testing::TemporaryFile place("old");
  const fs::path link = place.folder() / "link";
  fs::create_symlink(place.path(), link);
  EXPECT_THROW(write_whole_file(link.string(), [](std::ostream& out) { out << "new"; }), ConfigError);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(text_of(place.path()), "old");
}

TEST(Text, IsUtf8WithoutControlCharacters) {
  for (const char* text : {"", "plain\n", "µm", "2β", "\xF0\x9F\x98\x80", "tab\t"})
    EXPECT_TRUE(is_text(text)) << text;
  for (const char* bytes : {"\x01", "a\x7f", "\xff", "\xc0\xaf", "\xe2\x82", "\xc3", "\xf5\x80\x80\x80"})
    EXPECT_FALSE(is_text(bytes));
  EXPECT_FALSE(is_text(std::string("a\0b", 3)));
}

TEST(WholeFile, LeavesWhatChangedMeanwhile) {
  const testing::TemporaryFile place("old");
  const auto write = [&](std::ostream& out) {
    out << "new";
    std::ofstream(place.path()) << "precious";
  };
  EXPECT_THROW(write_whole_file(place.path(), write), ConfigError);
  EXPECT_EQ(text_of(place.path()), "precious");
  EXPECT_EQ(std::distance(fs::directory_iterator(place.folder()), {}), 1) << "nothing is left aside";
}

TEST(WholeFile, LeavesWhatCameSinceTheFirstLook) {
  const testing::TemporaryFile place("ours");
  const std::string found = content_identity(place.path());
  fs::remove(place.path());
  std::ofstream(place.path()) << "precious";
  const auto write = [](std::ostream& out) { out << "new"; };
  EXPECT_THROW(write_whole_file(place.path(), write, found), ConfigError);
  EXPECT_EQ(text_of(place.path()), "precious");
  write_whole_file(place.path(), write, content_identity(place.path()));
  EXPECT_EQ(text_of(place.path()), "new");
}

TEST(WholeFile, TakesThePlaceOfWhatItFoundAlone) {
  const testing::TemporaryFile place("old");
  write_whole_file(place.path(), [](std::ostream& out) { out << "new"; });
  EXPECT_EQ(text_of(place.path()), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(place.folder()), {}), 1) << "nothing is left aside";
  const auto moved_over = [&](std::ostream& out) {
    out << "newer";
    std::ofstream(place.folder() / "other") << "mine";
    fs::rename(place.folder() / "other", place.path());
  };
  EXPECT_THROW(write_whole_file(place.path(), moved_over), ConfigError);
  EXPECT_EQ(text_of(place.path()), "mine");
}

TEST(WholeFile, IsReadByThoseWhoMightReadTheOneBefore) {
  const testing::TemporaryFile place("old");
  for (const int mode : {0600, 0640, 0444}) {
    fs::permissions(place.path(), fs::perms(mode));
    write_whole_file(place.path(), [](std::ostream& out) { out << "new"; });
    EXPECT_EQ(fs::status(place.path()).permissions(), fs::perms(mode));
  }
}

TEST(WholeFile, GoesOnWhereAHandleStands) {
  const testing::TemporaryFile place("first,");
  const auto write = [](std::ostream& out) { out << "second," << std::string(1, 'x') << 3; };
  const int handle = open(place.path().c_str(), O_WRONLY | O_APPEND);
  for (const char* folder : {"/dev/fd/", "/proc/self/fd/"})
    write_whole_file(folder + std::to_string(handle), write);
  close(handle);
  EXPECT_EQ(text_of(place.path()), "first,second,x3second,x3");
}

TEST(WholeFile, WritesNothingThroughAHandleThatIsForReading) {
  const testing::TemporaryFile place("mine");
  const int handle = open(place.path().c_str(), O_RDONLY);
  const std::string path = "/dev/fd/" + std::to_string(handle);
  EXPECT_THROW(write_whole_file(path, [](std::ostream& out) { out << "new"; }), std::runtime_error);
  close(handle);
  EXPECT_EQ(text_of(place.path()), "mine");
}

}  // namespace
}  // namespace gapscope
