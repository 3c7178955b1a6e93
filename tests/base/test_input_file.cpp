#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "base/input_file.h"
#include "gapscope/base/errors.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::StartsWith;
using testing::TemporaryFile;

std::string refusal(const std::string& path) {
  try {
    open_input_file(path, "a table");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "(opened)";
}

TEST(InputFile, IsOpenedWhereItIsAFileThatIsThere) {
  const TemporaryFile file("text");
  std::string word;
  open_input_file(file.path(), "a table") >> word;
  EXPECT_EQ(word, "text");
  EXPECT_TRUE(try_input_file(file.path()).is_open());
}

/// A pipe that nobody writes to would never open.
TEST(InputFile, WhatIsNoFileIsRefusedAtOnce) {
  const TemporaryFile file("text");
  const std::string folder = file.folder().string(), pipe = folder + "/pipe", link = folder + "/link";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink(pipe, link);
  for (const std::string& path : {pipe, link, folder, std::string("/dev/zero")}) {
    EXPECT_EQ(refusal(path), path + ": is no regular file, expected a table");
    EXPECT_FALSE(try_input_file(path).is_open());
  }
  const TemporaryFile nothing("");
  for (const std::string& path : {nothing.path(), std::string("/proc/kmsg")})
    EXPECT_EQ(refusal(path), path + ": is empty, expected a table")
        << "the kernel's log waits for its reader";
  EXPECT_EQ(refusal(folder + "/none"), folder + "/none: there is no such file, expected a table");
  EXPECT_FALSE(try_input_file(folder + "/none").is_open());
}

}  // namespace
}  // namespace gapscope
