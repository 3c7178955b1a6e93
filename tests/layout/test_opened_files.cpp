// Files that somebody names are opened in one place, which refuses what is none.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

/// A pipe that is opened anywhere else is waited for.
TEST(Layout, FilesThatAreReadAreOpenedInOnePlace) {
  const std::regex opened(R"rx(std::ifstream(\s+\w+)?\((?!const|\))|std::ifstream\s+\w+\{|LoadFile\()rx");
  const std::set<std::string> own = {"src/base/input_file.cpp",
                                     "src/base/run_apart.cpp"};  // of the kernel, the second one
  std::set<std::string> found;
  for (const char* top : {"include/gapscope", "src"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GAPSCOPE_SOURCE_DIR) / top)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, opened))
          found.insert(fs::relative(entry.path(), fs::path(GAPSCOPE_SOURCE_DIR)).string());
    }
  EXPECT_EQ(found, own);
}

}  // namespace
