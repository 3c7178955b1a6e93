// Wording, held in files that are read as a diff: tests/MODULE/told/TEST_FILE.txt, one section for each test.
// GAPSCOPE_RENEW_TOLD=1 build/bin/test_MODULE writes them anew; no test of a decision reads a sentence.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace gapscope::testing {

/// The sections of one file, and what the tests of this process have told.
class ToldFile {
 public:
  explicit ToldFile(std::filesystem::path path) : path_(std::move(path)) {
    std::ifstream in(path_);
    std::string section;
    for (std::string line; std::getline(in, line);)
      if (line.starts_with("## "))
        sections_[section = line.substr(3)];
      else if (line.starts_with("- "))
        sections_[section].push_back(line.substr(2));
  }
  ToldFile(const ToldFile&) = delete;
  ToldFile& operator=(const ToldFile&) = delete;
  ~ToldFile() {
    if (!renews()) return;
    for (auto& [section, told] : told_) sections_[section] = told;
    std::filesystem::create_directories(path_.parent_path());
    std::ofstream out(path_);
    for (const auto& [section, lines] : sections_) {
      out << (&section == &sections_.begin()->first ? "" : "\n") << "## " << section << "\n";
      for (const std::string& line : lines) out << "- " << line << "\n";
    }
  }

  ::testing::AssertionResult holds(const std::string& test, const std::string& text) {
    if (text.empty()) return ::testing::AssertionFailure() << test << " told nothing";
    std::vector<std::string>& told = told_[test];
    told.push_back(text);
    if (renews()) return ::testing::AssertionSuccess();
    const std::vector<std::string>& held = sections_[test];
    const std::string expected = told.size() > held.size() ? "nothing" : held[told.size() - 1];
    if (expected == text) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << path_.string() << ", " << test << ", line " << told.size()
                                         << "\n  has  " << expected << "\n  told " << text;
  }

 private:
  static bool renews() { return std::getenv("GAPSCOPE_RENEW_TOLD") != nullptr; }

  std::filesystem::path path_;
  std::map<std::string, std::vector<std::string>> sections_, told_;
};

inline ::testing::AssertionResult is_told(const char* source, const std::string& text) {
  static std::map<std::string, ToldFile> files;
  const std::filesystem::path from = source;
  const auto path = from.parent_path() / "told" / (from.stem().string() + ".txt");
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  return files.try_emplace(path.string(), path)
      .first->second.holds(std::string(test->test_suite_name()) + "." + test->name(), text);
}

/// The first line of a text that has this in it; empty: none has.
inline std::string line_with(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  if (at == text.npos) return "";
  const std::size_t begin = text.rfind('\n', at) + 1, end = text.find('\n', at);
  return text.substr(begin, end - begin);
}

/// That a sentence is the one of the file, in the order in which a test tells them.
#define EXPECT_TOLD(text) EXPECT_TRUE(::gapscope::testing::is_told(__FILE__, text))

}  // namespace gapscope::testing
