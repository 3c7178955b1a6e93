// What a report replaces, what it keeps of an earlier one, and what remains when it is not finished.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "gapscope/base/errors.h"
#include "results/report_folder.h"
#include "results/report_folder_use.h"
#include "results/scratch_folder.h"

namespace gapscope {
namespace {

using test::files_in;
using test::Names;
using test::put;
using test::refused;
using test::write;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::refusal;
using testing::text_of;
namespace fs = std::filesystem;

/// A stored half of a report.
std::string half(const std::string& version, const std::string& sha256) {
  return R"({"version": ")" + version + R"(", "sources": [{"file": "c.yaml", "sha256": ")" + sha256 +
         R"("}]})";
}

TEST(ReportFolder, AppearsOnlyWithCommitAndListsItsFiles) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "deep" / "rig";
  ReportFolder folder(target.string(), FolderKind::kDrive);
  put(fs::path(folder.path()) / "result.json", "new");
  put(fs::path(folder.path()) / "traces" / "1_a.csv", "t");
  EXPECT_FALSE(fs::exists(target / "result.json"));
  folder.commit();
  EXPECT_EQ(files_in(target), (Names{"files.json", "result.json", "traces/1_a.csv"}));
  EXPECT_THAT(text_of(target / "files.json"), AllOf(HasSubstr("traces/1_a.csv"), HasSubstr("result.json")));
  EXPECT_EQ(files_in(scratch.path).size(), 3u) << "the temporary folder is gone";
}

TEST(ReportFolder, ReplacesWhatItWroteAndLeavesTheRest) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "rig";
  write(target, {"result.json", "overview.png", "fig3.png", "report.md", "traces/1_a.csv", "traces/2_b.csv"},
        "old");
  for (const char* name : {"notes.txt", "photo.png", "photos/rig.png"}) put(target / name, "mine");
  write(target.string() + "/", {"result.json", "overview.png", "traces/1_a.csv"}, "new");
  EXPECT_EQ(files_in(target), (Names{"files.json", "result.json", "overview.png", "traces/1_a.csv",
                                     "notes.txt", "photo.png", "photos/rig.png"}));
  EXPECT_EQ(text_of(target / "result.json"), "new");
  EXPECT_EQ(text_of(target / "photo.png"), "mine");
}

TEST(ReportFolder, KnowsItsFilesAlsoWhereAKillLeftTwoHashesOfOne) {
  ScratchFolder scratch;
  write(scratch.path, {"result.json", "report.md"}, "old");
  std::string list = text_of(scratch.path / "files.json");
  const std::size_t at = list.find("  {\n   \"file\": \"report.md\"");
  ASSERT_NE(at, list.npos);
  list.insert(at,
              "  {\n   \"file\": \"report.md\",\n   \"sha256\": \"" + std::string(64, '0') + "\"\n  },\n");
  put(scratch.path / "files.json", list);
  write(scratch.path, {"result.json", "report.md"}, "new");
  EXPECT_EQ(text_of(scratch.path / "report.md"), "new");
  EXPECT_EQ(refused(scratch.path), "");
}

TEST(ReportFolder, ReplacesNoInput) {
  ScratchFolder scratch;
  const fs::path rig = scratch.path / "rig";
  write(rig, {"result.json", "fitted.yaml"}, "old");
  EXPECT_THAT(refused(rig, FolderKind::kDrive, {(rig / "fitted.yaml").string()}),
              HasSubstr("fitted.yaml: is read, and would be replaced by the report"));
  put(rig / "mine.yaml", "beside it");
  EXPECT_EQ(refused(rig, FolderKind::kDrive, {(rig / "mine.yaml").string()}), "");
}

TEST(ReportFolder, IsAsItWasWhereAFileCannotBeReplaced) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "rig";
  write(target, {"result.json", "report.md", "traces/1_a.csv"}, "old");
  const std::string list = text_of(target / "files.json");
  ReportFolder folder(target.string(), FolderKind::kDrive);
  for (const char* name : {"result.json", "report.md"}) put(fs::path(folder.path()) / name, "new");
  fs::create_directory(fs::path(folder.path()) / ".replaced");
  put(fs::path(folder.path()) / ".replaced/traces", "in the way of what goes there");
  EXPECT_THROW(folder.commit(), std::runtime_error);
  for (const char* name : {"result.json", "report.md", "traces/1_a.csv"})
    EXPECT_EQ(text_of(target / name), "old");
  EXPECT_EQ(text_of(target / "files.json"), list);
}

TEST(ReportFolder, IsWrittenByOneAtATime) {
  ScratchFolder scratch;
  ReportFolder first((scratch.path / "rig").string(), FolderKind::kDrive);
  EXPECT_THAT(refused(scratch.path / "rig"), HasSubstr("is being written by another process"));
}

TEST(ReportFolder, OthersBesideItMayComeAndGo) {
  ScratchFolder scratch;
  const auto come_and_go = [&](const char* name) {
    for (int i = 0; i < 200; ++i) ReportFolder((scratch.path / "all" / name).string(), FolderKind::kDrive);
  };
  std::thread other(come_and_go, "b");
  EXPECT_NO_THROW(come_and_go("a"));
  other.join();
}

TEST(ReportFolder, IsReadableForOthersAsAnyNewFolderIs) {
  ScratchFolder scratch;
  write(scratch.path / "rig", {"result.json"}, "new");
  EXPECT_NE(fs::status(scratch.path / "rig").permissions() & fs::perms::others_exec, fs::perms::none);
}

TEST(ReportFolder, NamesThePlaceThatCannotBeWritten) {
  ScratchFolder scratch;
  put(scratch.path / "file", "x");
  EXPECT_THAT(refused(scratch.path / "file"), HasSubstr("file: is a file, expected the folder of a report"));
  EXPECT_THAT(refused(scratch.path / "file" / "rig"), HasSubstr((scratch.path / "file").string()));
  EXPECT_THAT(refused(scratch.path / std::string(300, 'a')), HasSubstr("File name too long"));
}

TEST(ReportFolder, KeepsTheOtherHalfOnlyOfTheSameDrive) {
  const std::vector<FileHash> sources = {{"c.yaml", "1"}};
  const auto dropped = [&](const std::string& stored) {
    ScratchFolder scratch;
    write(scratch.path, {"diagnosis.json", "fitted.yaml", "traces/held_out_1_a.csv"}, stored);
    ReportFolder folder(scratch.path.string(), FolderKind::kDrive);
    folder.keep_diagnosis("2", sources);
    put(fs::path(folder.path()) / "result.json", "new");
    folder.commit();
    EXPECT_EQ(fs::exists(scratch.path / "diagnosis.json"), folder.dropped().empty());
    EXPECT_EQ(fs::exists(scratch.path / "traces/held_out_1_a.csv"), folder.dropped().empty());
    return folder.dropped();
  };
  EXPECT_EQ(dropped(half("2", "1")), "");
  EXPECT_THAT(dropped(half("1", "1")), HasSubstr("made from another version of gapscope"));
  EXPECT_THAT(dropped(half("2", "3")), HasSubstr("The diagnosis in this folder was dropped, as it was "
                                                 "made from another c.yaml"));
  EXPECT_THAT(dropped(R"({"version": "2"})"), HasSubstr("another c.yaml"));
  EXPECT_THAT(dropped("no JSON"), HasSubstr("cannot be read"));
}

TEST(ReportFolder, AnEstimateThatIsKeptBringsNoTraceOfTheDiagnosisBefore) {
  ScratchFolder scratch;
  write(scratch.path, {"result.json", "traces/1_a.csv", "traces/held_out_1_b.csv"}, half("2", "1"));
  ReportFolder folder(scratch.path.string(), FolderKind::kDrive);
  folder.keep_estimate("2", {{"c.yaml", "1"}});
  put(fs::path(folder.path()) / "diagnosis.json", "new");
  folder.commit();
  EXPECT_EQ(text_of(scratch.path / "result.json"), half("2", "1"));
  EXPECT_EQ(files_in(scratch.path), (Names{"files.json", "diagnosis.json", "result.json", "traces/1_a.csv"}));
  EXPECT_EQ(refused(scratch.path), "") << "what was kept is still known as its own";
}

}  // namespace
}  // namespace gapscope
