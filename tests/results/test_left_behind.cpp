// What a process leaves in the folder of a report that is killed on its way, or cannot remove what it made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "results/report_folder.h"
#include "results/report_folder_use.h"
#include "results/scratch_folder.h"
#include "support/company.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using test::put;
using test::refused;
using test::write;
using testing::text_of;
namespace fs = std::filesystem;

constexpr const char* kMark = "A report that is being written; may be removed when nobody writes it.\n";

int being_all_of(const fs::path& folder, const std::string& text) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (fs::is_regular_file(entry.symlink_status()) && text_of(entry.path()) == text) ++count;
  return count;
}

int partial_folders(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(".gapscope-partial-")) ++count;
  return count;
}

TEST(LeftBehind, WhatNobodyKnowsAsGapscopesIsShownAgain) {
  ScratchFolder scratch;
  const fs::path rig = scratch.path / "rig", left = rig / ".gapscope-partial-abcdef";
  write(rig, {"result.json", "report.md"}, "old");
  put(left / ".made-by-gapscope", kMark);
  put(left / ".replaced/report.md", "mine");
  put(left / "result.json", "half");
  EXPECT_EQ(refused(rig), "");
  EXPECT_EQ(text_of(rig / "not_put_back_abcdef/report.md"), "mine");
  EXPECT_FALSE(fs::exists(left));
}

/// A report in the folder is replaced; somebody saves his own under the name of one of its files at one
/// moment, and at a later one the process is killed. The next report takes the folder then, if it can.
TEST(LeftBehind, NothingThatCameBeforeAKillIsLost) {
  if (!testing::company_can_come()) GTEST_SKIP() << "no filter of system calls here";
  for (const char* file : {"report.md", "files.json", "result.json"})
    for (int when = 1, moments = 1; when <= moments; ++when)
      for (int killed = when; killed <= std::min(when + 2, moments); ++killed) {
        ScratchFolder scratch;
        const fs::path rig = scratch.path / "rig";
        write(rig, {"result.json", "report.md"}, "old");
        const auto company = [&](int moment, long) {
          if (moment == when) {
            put(scratch.path / "saved", "mine");
            fs::rename(scratch.path / "saved", rig / file);
          }
          if (moment == killed && killed > when) _exit(9);
          return 0;
        };
        const auto ended = testing::in_company(company, [&] {
          write(rig, {"result.json", "report.md"}, "new");
        });
        if (killed == when) moments = ended.moments;
        const std::string next = refused(rig);
        EXPECT_EQ(being_all_of(scratch.path, "mine"), 1)
            << file << " " << when << " " << killed << ": " << next;
        EXPECT_EQ(partial_folders(rig), 0) << file << " " << when << " " << killed << ": " << next;
      }
}

/// A folder with a hidden file only, or a link to one, takes the name of the report, and then a file does.
TEST(LeftBehind, AFolderThatCameIsNotTakenForNothing) {
  if (!testing::company_can_come()) GTEST_SKIP() << "no filter of system calls here";
  for (const bool linked : {false, true})
    for (int when = 1, moments = 1; when <= moments; ++when) {
      ScratchFolder scratch;
      const fs::path rig = scratch.path / "rig", report = rig / "report.md";
      write(rig, {"result.json", "report.md"}, "old");
      const auto company = [&](int moment, long) {
        if (moment == when) {
          fs::remove(report);
          put(scratch.path / "mine/.hidden", "mine");
          if (linked)
            fs::create_symlink("../mine", report);
          else
            fs::rename(scratch.path / "mine", report);
        }
        if (moment > when && !fs::exists(fs::symlink_status(report))) put(report, "mine, too");
        return 0;
      };
      moments = testing::in_company(company, [&] {
                  write(rig, {"result.json", "report.md"}, "new");
                }).moments;
      int links = 0;
      for (const auto& entry : fs::recursive_directory_iterator(rig)) links += entry.is_symlink() ? 1 : 0;
      EXPECT_EQ(being_all_of(scratch.path, "mine"), 1) << when;
      EXPECT_EQ(links, linked ? 1 : 0) << when;
    }
}

TEST(LeftBehind, AKillAloneLeavesNothingThatIsShown) {
  if (!testing::company_can_come()) GTEST_SKIP() << "no filter of system calls here";
  for (int killed = 0, moments = 1; killed <= moments; ++killed) {
    ScratchFolder scratch;
    const fs::path rig = scratch.path / "rig";
    write(rig, {"result.json", "report.md", "traces/1_a.csv", "fig1.png"}, "old");
    const auto company = [&](int moment, long) {
      if (moment == killed) _exit(9);
      return 0;
    };
    const auto ended = testing::in_company(company, [&] {
      write(rig, {"result.json", "report.md", "traces/2_b.csv"}, "new");
    });
    if (killed == 0) moments = ended.moments;
    write(rig, {"result.json", "report.md", "traces/2_b.csv"}, "new");
    EXPECT_EQ(test::files_in(rig), (test::Names{"files.json", "result.json", "report.md", "traces/2_b.csv"}))
        << killed;
  }
}

TEST(LeftBehind, WhatCannotBeListedKeepsItsMarkAndGoesWithTheNextReport) {
  ScratchFolder scratch;
  const fs::path rig = scratch.path / "rig";
  fs::create_directory(rig);
  rlimit was{};
  getrlimit(RLIMIT_NOFILE, &was);
  {
    ReportFolder folder(rig.string(), FolderKind::kDrive);
    put(fs::path(folder.path()) / "traces/1_a.csv", "new");
    const rlimit none{3, was.rlim_max};  // of handles: the lock of the folder has one above
    setrlimit(RLIMIT_NOFILE, &none);
  }
  setrlimit(RLIMIT_NOFILE, &was);
  EXPECT_EQ(partial_folders(rig), 1);
  EXPECT_EQ(refused(rig), "");
  EXPECT_EQ(partial_folders(rig), 0);
}

}  // namespace
}  // namespace gapscope
