// What may happen to a folder between the last look at it and the moment when files change places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "results/file_list.h"
#include "results/folder_content.h"
#include "results/replace_files.h"
#include "results/scratch_folder.h"
#include "results/sha256.h"
#include "support/company.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::text_of;
namespace fs = std::filesystem;

TEST(FolderContent, TakesNothingAwayThatChangedInTheLastMoment) {
  ScratchFolder scratch;
  const fs::path from = scratch.path / "from", to = scratch.path / "to";
  for (const fs::path& folder : {from, to}) fs::create_directory(folder);
  std::ofstream(from / "report.md") << "new";
  std::ofstream(to / "report.md") << "mine";
  const internal::results::FileList before{"", "drive", "", {{"report.md", sha256("old")}}};
  const auto is_result = [](const std::string&) { return false; };
  const std::string refused = testing::refusal([&] {
    internal::results::replace_files(from, to, {"report.md"}, {}, scratch.path / "aside", is_result, &before);
  });
  EXPECT_THAT(refused, HasSubstr("report.md: changed meanwhile"));
  EXPECT_EQ(text_of(to / "report.md"), "mine");
  EXPECT_EQ(text_of(from / "report.md"), "new");
}

TEST(FolderContent, TakesNothingBackOverWhatCameMeanwhile) {
  ScratchFolder scratch;
  const fs::path from = scratch.path / "from", to = scratch.path / "to";
  for (const fs::path& folder : {from, to}) fs::create_directory(folder);
  for (const char* file : {"a", "b"}) std::ofstream(from / file) << "new";
  std::ofstream(to / "a") << "old";
  std::ofstream(to / "b") << "mine";  // and not what is listed
  const internal::results::FileList before{"", "drive", "", {{"a", sha256("old")}, {"b", sha256("old")}}};
  const std::string refused = testing::refusal([&] {
    internal::results::replace_files(
        from, to, {"a", "b"}, {}, scratch.path / "aside", [](const std::string& file) { return file == "a"; },
        &before);
  });
  EXPECT_THAT(refused, HasSubstr("b: changed meanwhile"));
  EXPECT_EQ(text_of(to / "a"), "old");
  EXPECT_EQ(text_of(to / "b"), "mine");
}

TEST(FolderContent, TakesNoFileOfTheUserForAnEmptyFolder) {
  ScratchFolder scratch;
  const fs::path from = scratch.path / "from", to = scratch.path / "to";
  for (const fs::path& folder : {from, to}) fs::create_directory(folder);
  std::ofstream(from / "a") << "new";
  std::ofstream(to / "traces") << "mine";
  internal::results::replace_files(
      from, to, {"a"}, {}, from / ".replaced", [](const std::string&) { return false; }, nullptr);
  EXPECT_EQ(text_of(to / "traces"), "mine");
}

/// What is somebody else's, wherever it is below a folder.
int holding(const fs::path& folder, const std::string& text) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (fs::is_regular_file(entry.symlink_status()) && text_of(entry.path()).find(text) != std::string::npos)
      ++count;
  return count;
}

TEST(FolderContent, ALineThatWasAppendedAtAnyMomentIsThereAfterwards) {
  if (!testing::company_can_come()) GTEST_SKIP() << "no filter of system calls here";
  for (int when = 1, moments = 1; when <= moments; ++when) {
    ScratchFolder scratch;
    const fs::path from = scratch.path / "from", to = scratch.path / "to";
    for (const fs::path& folder : {from, to}) fs::create_directory(folder);
    for (const char* file : {"a", "b"}) std::ofstream(from / file) << "new";
    for (const char* file : {"a", "b"}) std::ofstream(to / file) << "old";
    const internal::results::FileList before{"", "drive", "", {{"a", sha256("old")}, {"b", sha256("old")}}};
    const auto company = [&](int moment, long) {
      if (moment == when) std::ofstream(to / "a", std::ios::app) << "mine";
      if (moment > when && !fs::exists(to / "b")) std::ofstream(to / "b") << "in the way";
      return 0;
    };
    moments = testing::in_company(company, [&] {
                internal::results::replace_files(
                    from, to, {"a", "b"}, {}, from / ".replaced", [](const std::string&) { return false; },
                    &before);
              }).moments;
    fs::remove_all(from);
    EXPECT_EQ(holding(to, "mine"), 1) << "moment " << when;
  }
}

}  // namespace
}  // namespace gapscope
