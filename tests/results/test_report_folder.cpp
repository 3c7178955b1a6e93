#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "gapscope/results/report_folder.h"
#include "results/scratch_folder.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using testing::text_of;
namespace fs = std::filesystem;

using Names = std::set<std::string>;

void put(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

Names files_in(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

TEST(ReportFolder, AppearsOnlyWithCommit) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "deep" / "rig";
  ReportFolder folder(target.string());
  put(fs::path(folder.path()) / "result.json", "new");
  put(fs::path(folder.path()) / "traces" / "1_a.csv", "t");
  EXPECT_FALSE(fs::exists(target));
  folder.commit();
  EXPECT_EQ(files_in(target), (Names{"result.json", "traces/1_a.csv"}));
  EXPECT_EQ(files_in(scratch.path).size(), 2u) << "the temporary folder is gone";
}

TEST(ReportFolder, LeavesNoTraceWithoutCommit) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "rig";
  put(target / "result.json", "old");
  {
    ReportFolder folder(target.string());
    put(fs::path(folder.path()) / "result.json", "new");
    EXPECT_EQ(fs::path(folder.path()).parent_path(), scratch.path) << "a sibling, so that moving is renaming";
    EXPECT_TRUE(fs::path(folder.path()).filename().string().starts_with(".rig.partial-"));
  }
  EXPECT_EQ(files_in(scratch.path), Names{"rig/result.json"});
  EXPECT_EQ(text_of(target / "result.json"), "old");
}

TEST(ReportFolder, ReplacesAnOldReportAndNothingElse) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "rig";
  for (const char* name : {"result.json", "overview.png", "fig3.png", "report.md", "timing.json",
                           "resolved.yaml", "traces/1_a.csv", "traces/2_b.csv"})
    put(target / name, "old");
  put(target / "report.md", "![overview](overview.png)\n![map](fig3.png)\n");
  for (const char* name : {"notes.txt", "photo.png", "photos/rig.png", "traces/mine.txt"})
    put(target / name, "mine");
  ReportFolder folder(target.string() + "/");
  for (const char* name : {"result.json", "overview.png", "traces/1_a.csv"})
    put(fs::path(folder.path()) / name, "new");
  folder.commit();
  EXPECT_EQ(files_in(target), (Names{"result.json", "overview.png", "traces/1_a.csv", "notes.txt",
                                     "photo.png", "photos/rig.png", "traces/mine.txt"}));
  EXPECT_EQ(text_of(target / "result.json"), "new");
  EXPECT_EQ(text_of(target / "notes.txt"), "mine");
}

TEST(ReportFolder, IsReadableForOthersAsAnyNewFolderIs) {
  ScratchFolder scratch;
  ReportFolder folder((scratch.path / "rig").string());
  put(fs::path(folder.path()) / "result.json", "new");
  folder.commit();
  EXPECT_NE(fs::status(scratch.path / "rig").permissions() & fs::perms::others_exec, fs::perms::none);
}

TEST(ReportFolder, NamesThePlaceThatCannotBeWritten) {
  ScratchFolder scratch;
  put(scratch.path / "file", "x");
  for (const fs::path& path : {scratch.path / "file" / "rig", scratch.path / "file"}) {
    try {
      ReportFolder folder(path.string());
      FAIL() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find((scratch.path / "file").string()), std::string::npos)
          << error.what();
    }
  }
}

TEST(ReportFolder, AFolderInTheWayIsAnErrorWithItsPath) {
  ScratchFolder scratch;
  put(scratch.path / "rig" / "result.json" / "x", "a folder of that name");
  ReportFolder folder((scratch.path / "rig").string());
  put(fs::path(folder.path()) / "result.json", "new");
  try {
    folder.commit();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("rig/result.json"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gapscope
