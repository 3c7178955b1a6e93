// What a report leaves alone, and what it refuses to be written into.
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

TEST(ReportFolder, LeavesNoTraceWithoutCommit) {
  ScratchFolder scratch;
  write(scratch.path / "rig", {"result.json"}, "old");
  const Names before = files_in(scratch.path);
  {
    ReportFolder folder((scratch.path / "rig").string(), FolderKind::kDrive);
    put(fs::path(folder.path()) / "result.json", "new");
    ReportFolder other((scratch.path / "a" / "b").string(), FolderKind::kDrive);
  }
  EXPECT_EQ(files_in(scratch.path), before);
  EXPECT_FALSE(fs::exists(scratch.path / "a"));
  EXPECT_EQ(text_of(scratch.path / "rig/result.json"), "old");
}

TEST(ReportFolder, RefusesAFolderOfSomethingElse) {
  for (const char* name :
       {"drive.csv", "traces/drive.csv", "report.md", "result.json", ".git/config", "blind.json"}) {
    ScratchFolder scratch;
    put(scratch.path / name, "mine");
    const Names before = files_in(scratch.path);
    EXPECT_THAT(refused(scratch.path), HasSubstr("and no report of gapscope, expected an empty folder"))
        << name;
    EXPECT_EQ(files_in(scratch.path), before);
  }
}

TEST(ReportFolder, RefusesWhatTheUserPutInItsPlaceOrChanged) {
  for (const char* name : {"diagnosis.json", "traces/mine.csv", "resolved.yaml", "fitted.yaml"}) {
    ScratchFolder scratch;
    write(scratch.path / "rig", {"result.json", "report.md"}, "old");
    put(scratch.path / "rig" / name, "mine");
    EXPECT_THAT(refused(scratch.path / "rig"), HasSubstr("which gapscope did not write there")) << name;
  }
  ScratchFolder scratch;
  write(scratch.path / "rig", {"result.json", "overview.png"}, "old");
  put(scratch.path / "rig/overview.png", "a better one");
  EXPECT_THAT(refused(scratch.path / "rig"),
              HasSubstr("holds 'overview.png', which was changed since gapscope wrote it"));
}

TEST(ReportFolder, FollowsNoLinks) {
  ScratchFolder scratch;
  put(scratch.path / "elsewhere/1_a.csv", "t");
  write(scratch.path / "rig", {"result.json", "traces/1_a.csv"}, "t");
  fs::remove_all(scratch.path / "rig/traces");
  fs::create_directory_symlink(scratch.path / "elsewhere", scratch.path / "rig/traces");
  EXPECT_THAT(refused(scratch.path / "rig"), HasSubstr("'traces"));
  fs::remove(scratch.path / "rig/traces");
  fs::remove(scratch.path / "rig/result.json");
  fs::create_symlink(scratch.path / "elsewhere/1_a.csv", scratch.path / "rig/result.json");
  EXPECT_THAT(refused(scratch.path / "rig"), HasSubstr("result.json"));
}

TEST(ReportFolder, TakesAFolderThatIsALinkItself) {
  ScratchFolder scratch;
  fs::create_directory(scratch.path / "disk");
  fs::create_directory_symlink(scratch.path / "disk", scratch.path / "link");
  write(scratch.path / "link", {"result.json"}, "new");
  EXPECT_EQ(files_in(scratch.path / "disk"), (Names{"files.json", "result.json"}));
}

TEST(ReportFolder, RefusesAReportOfAnotherKind) {
  ScratchFolder scratch;
  write(scratch.path / "check", {"blind.json", "report.md"}, "an hour of work", FolderKind::kBlind);
  EXPECT_THAT(refused(scratch.path / "check"), HasSubstr("holds a report of another kind (blind)"));
  EXPECT_EQ(refused(scratch.path / "check", FolderKind::kBlind), "");
}

/// Of one that is stored, and of data that come; whether these are refused.
bool are_other(const std::string& name, const std::string& sources, const ReportedData& data) {
  ScratchFolder scratch;
  write(scratch.path, {"diagnosis.json"},
        R"({"name": ")" + name + R"(", "version": "1", "sources": [)" + sources + "]}");
  ReportFolder folder(scratch.path.string(), FolderKind::kDrive);
  EXPECT_TRUE(folder.replaces());
  const std::string said = refusal([&] { folder.require_same_data(data); });
  EXPECT_TRUE(said.empty() || said.find("holds the report of other data (" + name) != said.npos) << said;
  return !said.empty();
}

TEST(ReportFolder, KnowsADriveByItsRecordingsAndASimulationByItsName) {
  const std::string asked = R"({"file": "configuration", "sha256": "0"})",
                    recorded =
                        asked + R"(, {"file": "a.csv", "sha256": "1"}, {"file": "b.csv", "sha256": "2"})";
  const FileHash configuration{"configuration", "9"};
  EXPECT_FALSE(are_other("rig", recorded, {"rig", false, {configuration, {"a.csv", "1"}}}));
  EXPECT_FALSE(are_other("rig", recorded, {"renamed", false, {configuration, {"moved.csv", "2"}}}));
  EXPECT_TRUE(are_other("rig", recorded, {"rig", false, {configuration, {"a.csv", "3"}}}))
      << "another drive, or recorded anew, under the same names";
  EXPECT_TRUE(are_other("rig", recorded, {"rig", false, {configuration, {"c.csv", "3"}}}));
  EXPECT_TRUE(are_other("rig", recorded, {"arm", false, {configuration, {"a.csv", "3"}}}));
  EXPECT_TRUE(are_other("rig", recorded, {"rig", true, {configuration}})) << "simulated";
  EXPECT_TRUE(are_other("rig", asked, {"rig", false, {configuration, {"a.csv", "1"}}})) << "simulated before";
  EXPECT_FALSE(are_other("rig", asked, {"rig", true, {configuration}}));
  EXPECT_TRUE(are_other("rig", asked, {"arm", true, {configuration}}));
  EXPECT_FALSE(are_other("rig", recorded, {"rig", false, {configuration, {"gone.csv", ""}}}))
      << "what is not there is told by who reads it";
  EXPECT_FALSE(are_other("rig", "", {"arm", false, {configuration, {"a.csv", "1"}}}))
      << "of an older version";
}

TEST(ReportFolder, RefusesAListThatReachesOutside) {
  for (const char* file : {"../victim.txt", "/victim.txt", "traces/../../victim.txt", "traces/..", ""}) {
    ScratchFolder scratch;
    put(scratch.path / "victim.txt", "mine");
    put(scratch.path / "rig/files.json",
        std::string(
            R"({"schema": "gapscope.files/1", "version": "1", "kind": "drive", "dropped": "", "files": [{"file": ")") +
            file + R"(", "sha256": ""}]})");
    EXPECT_THAT(refused(scratch.path / "rig"), HasSubstr("expected one in the folder itself")) << file;
  }
}

TEST(ReportFolder, RefusesWhatCameInTheWayDuringTheWork) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "rig";
  ReportFolder folder(target.string(), FolderKind::kDrive);
  put(fs::path(folder.path()) / "overview.png", "new");
  put(target / "overview.png", "mine");
  EXPECT_THAT(refusal([&] { folder.commit(); }), HasSubstr("rig/overview.png: is in the way"));
  EXPECT_EQ(text_of(target / "overview.png"), "mine");
}

TEST(ReportFolder, RemovesWhatAKilledProcessLeftAndNothingThatLooksLikeIt) {
  ScratchFolder scratch;
  const fs::path rig = scratch.path / "rig";
  put(rig / ".gapscope-partial-abcdef/.made-by-gapscope",
      "A report that is being written; may be removed when nobody writes it.\n");
  put(rig / ".gapscope-partial-abcdef/result.json", "half");
  put(rig / ".gapscope-partial-backup/photo.png", "mine");
  fs::create_directory(rig / ".gapscope-partial-ghijkl");  // killed before its mark
  EXPECT_THAT(refused(rig), HasSubstr(".gapscope-partial-backup"));
  EXPECT_FALSE(fs::exists(rig / ".gapscope-partial-abcdef"));
  EXPECT_FALSE(fs::exists(rig / ".gapscope-partial-ghijkl"));
  EXPECT_TRUE(fs::exists(rig / ".gapscope-partial-backup/photo.png"));
}

TEST(ReportFolder, RemovesNothingThatCameInItsPlace) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "new";
  {
    ReportFolder folder(target.string(), FolderKind::kDrive);
    fs::remove_all(target);
    put(target, "precious");
  }
  EXPECT_EQ(text_of(target), "precious");
}

TEST(ReportFolder, RefusesAListThatChangedDuringTheWork) {
  ScratchFolder scratch;
  for (const bool before : {false, true}) {
    const fs::path target = scratch.path / (before ? "old" : "new");
    if (before) write(target, {"result.json"}, "old");
    ReportFolder folder(target.string(), FolderKind::kDrive);
    put(fs::path(folder.path()) / "result.json", "new");
    put(target / "files.json", "a list of mine");
    EXPECT_THAT(refusal([&] { folder.commit(); }), HasSubstr("files.json: changed during the work"));
    EXPECT_EQ(text_of(target / "files.json"), "a list of mine");
  }
}

TEST(ReportFolder, FollowsNoLinkThatWasPutDuringTheWork) {
  ScratchFolder scratch;
  const fs::path target = scratch.path / "rig";
  write(target, {"result.json", "traces/1_a.csv"}, "old");
  ReportFolder folder(target.string(), FolderKind::kDrive);
  put(fs::path(folder.path()) / "traces/1_a.csv", "new");
  fs::rename(target / "traces", scratch.path / "kept");
  fs::create_directory_symlink(scratch.path / "kept", target / "traces");
  EXPECT_THAT(refusal([&] { folder.commit(); }),
              HasSubstr("rig/traces: is no folder of gapscope's any more"));
  EXPECT_EQ(text_of(scratch.path / "kept/1_a.csv"), "old");
}

TEST(ReportFolder, LeavesStoresAndChecksToTheirOwnKind) {
  for (const char* name : {"results.sqlite", "labels.json", "answers.json", "cases/manifest.json"}) {
    ScratchFolder scratch;
    put(scratch.path / name, "somebody's");
    EXPECT_THAT(refused(scratch.path), HasSubstr("and no report of gapscope")) << name;
  }
  ScratchFolder scratch;
  put(scratch.path / "results.sqlite-journal", "left by a kill");
  EXPECT_EQ(refused(scratch.path, FolderKind::kCampaign), "");
  put(scratch.path / ".gapscope-123-456", "left by a kill");
  EXPECT_EQ(refused(scratch.path, FolderKind::kCampaign), "");
}

TEST(ReportFolder, DrawsNoReportOfAnotherKindAgain) {
  ScratchFolder scratch;
  write(scratch.path, {"gap_1.csv", "truth.csv"}, "recorded", FolderKind::kDrives);
  put(scratch.path / "result.json", "copied here");
  EXPECT_THAT(refusal([&] { ReportFolder::to_redraw(scratch.path.string(), FolderKind::kDrive); }),
              HasSubstr("another kind (drives)"));
}

TEST(ReportFolder, TakesNoMergeBesideTheLogOfAnotherStore) {
  ScratchFolder scratch;
  put(scratch.path / "results.sqlite-wal", "of another one");
  ReportFolder folder(scratch.path.string(), FolderKind::kCampaign);
  put(fs::path(folder.path()) / "results.sqlite", "merged");
  EXPECT_THAT(refusal([&] { folder.commit(); }), HasSubstr("results.sqlite-wal: is in the way"));
}

TEST(ReportFolder, AnEntryWithoutAHashIsBelievedOfWallTimesOnly) {
  ScratchFolder scratch;
  put(scratch.path / "notes.txt", "mine");
  put(scratch.path / "files.json",
      R"({"schema": "gapscope.files/1", "version": "1", "kind": "drive", "dropped": "", "files": [{"file": "notes.txt", "sha256": ""}]})");
  EXPECT_THAT(refused(scratch.path), HasSubstr("'notes.txt', which was changed"));
}

TEST(ReportFolder, DrawsAgainWithoutTouchingWhatIsStored) {
  ScratchFolder scratch;
  put(scratch.path / "result.json", "copied here");
  put(scratch.path / "traces/1_a.csv", "t");
  ReportFolder fresh = ReportFolder::to_redraw(scratch.path.string(), FolderKind::kDrive);
  EXPECT_EQ(text_of(fs::path(fresh.path()) / "result.json"), "copied here");
  put(fs::path(fresh.path()) / "report.md", "drawn");
  fresh.commit();
  EXPECT_EQ(files_in(scratch.path), (Names{"files.json", "result.json", "traces/1_a.csv", "report.md"}));
  EXPECT_THAT(refused(scratch.path), HasSubstr("'result.json', which gapscope did not write there"));
  put(scratch.path / "report.md", "with a word of my own");
  EXPECT_THAT(refusal([&] { ReportFolder::to_redraw(scratch.path.string(), FolderKind::kDrive); }),
              HasSubstr("'report.md', which was changed"));
}

TEST(ReportFolder, BehindALinkIsWhereTheSystemFindsIt) {
  ScratchFolder scratch;
  fs::create_directories(scratch.path / "other/deep");
  fs::create_directory(scratch.path / "work");
  fs::create_symlink("../other/deep", scratch.path / "work/link");
  write(scratch.path / "work/link/../out", {"result.json"}, "new");
  EXPECT_TRUE(fs::exists(scratch.path / "other/out/result.json"));
  EXPECT_FALSE(fs::exists(scratch.path / "work/out"));
}

}  // namespace
}  // namespace gapscope
