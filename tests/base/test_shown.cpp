#include <gtest/gtest.h>

#include "base/shown.h"

namespace gapscope {
namespace {

/// ESC, DEL, C1 as one byte and as UTF-8, marks of direction and unseen line ends, a character that is cut.
constexpr const char* kUnprintable[] = {"\x1b",         "\x7f",         "\x9b",         "\xc2\x9b",
                                        "\xe2\x80\xae", "\xe2\x80\x8f", "\xe2\x81\xa6", "\xe2\x80\xa8",
                                        "\xd8\x9c",     "\xc0\xaf"};

TEST(Shown, NothingThatATerminalObeys) {
  for (const std::string bad : kUnprintable) {
    EXPECT_EQ(printable("a" + bad + "b").find(bad), std::string::npos) << bad;
    EXPECT_TRUE(printable("a" + bad + "b").starts_with("a?"));
    EXPECT_FALSE(is_text("a" + bad)) << bad;
  }
  EXPECT_EQ(printable("a\xc2\x9b[31mb"), "a?[31mb") << "one for each character";
  EXPECT_FALSE(is_text("a\xe2\x80")) << "cut off";
}

TEST(Shown, WhatPeopleWriteStays) {
  for (const std::string word : {"Getriebe für 5 µm", "ギヤ", "תמסורת", "⚙"}) {
    EXPECT_EQ(printable(word), word);
    EXPECT_TRUE(is_text(word)) << word;
  }
  EXPECT_TRUE(is_text("a\tb\r\n"));
  EXPECT_EQ(printable("a\tb"), "a?b");
}

TEST(Shown, IsCutBetweenCharacters) {
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("abcd", 3), "abc...");
  EXPECT_EQ(printable("a\xc3\xbc", 2), "a...");
}

}  // namespace
}  // namespace gapscope
