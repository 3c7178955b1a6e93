// What the documents say of the sources is still so: files, constants.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kProject = GAPSCOPE_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> documents() {
  std::vector<fs::path> found = {kProject / "README.md"};
  for (const auto& entry : fs::directory_iterator(kProject / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// All matches of a pattern, each with its groups.
std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), {}};
}

TEST(Documents, NameOnlyFilesThatAreThere) {
  const std::regex named(R"rx(`((?:src|include|tests|configs|docs|\.ci)/[\w./]+)`)rx");
  const std::regex linked(R"rx(\]\(([\w./-]+)\))rx");
  for (const fs::path& document : documents()) {
    const std::string text = text_of(document);
    for (const std::smatch& m : matches(text, named))
      EXPECT_TRUE(fs::exists(kProject / m[1].str())) << document << " names " << m[1];
    for (const std::smatch& m : matches(text, linked))
      EXPECT_TRUE(fs::exists(document.parent_path() / m[1].str())) << document << " links to " << m[1];
  }
}

/// Somebody with a recording reads it in three minutes; what he does not need has a page of its own.
TEST(Documents, TheReadmeStaysShortAndEveryPageIsInTheIndex) {
  const std::string readme = text_of(kProject / "README.md"), index = text_of(kProject / "docs/README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 120);
  for (const auto& entry : fs::directory_iterator(kProject / "docs")) {
    if (entry.path().extension() != ".md" || entry.path().filename() == "README.md") continue;
    const std::string link = "](" + entry.path().filename().string() + ")";
    EXPECT_NE(index.find(link), std::string::npos) << link << " is not in docs/README.md";
  }
}

/// Each is shown by a page, with the command that draws it, and is no more than such a page needs.
TEST(Documents, ShowPicturesThatAreSmallAndSayHowTheyAreDrawn) {
  constexpr std::uintmax_t kMostBytes = 120'000;
  const std::regex shown(
      R"rx(!\[[^\]]+\]\((?:docs/)?(pictures/[\w.]+)\)\n\n\*[^*]*`gapscope report [^`]+ --small`)rx");
  std::set<std::string> pictures;
  for (const fs::path& document : documents()) {
    const std::string text = text_of(document);
    for (const std::smatch& m : matches(text, shown)) pictures.insert(m[1]);
  }
  EXPECT_GE(pictures.size(), 6u);
  for (const auto& entry : fs::directory_iterator(kProject / "docs/pictures")) {
    EXPECT_LT(entry.file_size(), kMostBytes) << entry.path();
    EXPECT_TRUE(pictures.contains("pictures/" + entry.path().filename().string())) << entry.path();
  }
}

/// Every constant and every field of the sources with each value that it is given somewhere.
std::multimap<std::string, double> constants() {
  const std::regex defined(R"rx(\b(k[A-Z]\w+|[a-z]+(?:_[a-z]+)*)\s*=\s*([\d.]+)\s*[;,])rx");
  std::multimap<std::string, double> found;
  for (const char* top : {"include", "src"})
    for (const auto& entry : fs::recursive_directory_iterator(kProject / top)) {
      if (!entry.is_regular_file()) continue;
      const std::string text = text_of(entry.path());
      for (const std::smatch& m : matches(text, defined)) found.emplace(m[1], std::stod(m[2]));
    }
  return found;
}

TEST(Documents, GiveConstantsTheValuesThatTheyHaveInTheSources) {
  const auto known = constants();
  const std::regex given(R"rx(`(k[A-Z]\w+|[a-z]+_[a-z_]+)`\s=\s(\d+(?:\.\d+)?))rx");
  for (const fs::path& document : documents()) {
    const std::string text = text_of(document);
    for (const std::smatch& m : matches(text, given)) {
      const auto [first, last] = known.equal_range(m[1]);
      EXPECT_TRUE(std::any_of(first, last, [&](const auto& c) { return c.second == std::stod(m[2]); }))
          << document << " gives " << m[1] << " as " << m[2] << ", the sources do not";
    }
  }
}

/// What a row says was counted with the version of its record, or the row says that it was not.
TEST(Documents, GiveEachHeadlineFigureTheVersionThatItWasCountedWith) {
  const std::string table = text_of(kProject / "docs/headline_figures.md");
  const std::regex row(R"rx(\]\((record/figures/\w+\.txt)\) \| ([^|;]*)(;[^|]*)? \|\n)rx");
  const auto rows = matches(table, row);
  EXPECT_GE(rows.size(), 26u);
  for (const std::smatch& m : rows) {
    const std::string record = text_of(kProject / "docs" / m[1].str()), counted_anew = m[3];
    EXPECT_TRUE(record.starts_with(m[2].str() + ";") || counted_anew.starts_with("; counted anew with "))
        << m[1] << " says " << record.substr(0, record.find('\n')) << ", the table " << m[2];
    EXPECT_NE(record.find("\n$ "), std::string::npos) << m[1] << " names no command with its seeds";
  }
}

}  // namespace
