// Nothing of the user's is ever taken: what commands refuse to write over, where they can write, what they
// leave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::text_of;
using testing::Workplace;

const std::string kThreeSeconds =
    "encoder: {bits: 18}\n"
    "simulation: {rate: 500, duration: 3, excitation: {sine: {amplitude: 0.58, frequency: 1}}}\n"
    "model: " +
    testing::kPaperModel;
constexpr const char* kRecording = "recording: {file: drive.csv}\n";

/// A configuration that simulates, a recording of it, and a report.
class UserFiles : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    start_ = new Workplace;
    start_->file("c.yaml", "name: rig\n" + kThreeSeconds);
    ASSERT_EQ(start_->run("simulate c.yaml -o drive.csv").status, 0);
    start_->file("rec.yaml", kRecording);
    ASSERT_EQ(start_->run("detect rec.yaml -o r").status, 0);
  }
  static void TearDownTestSuite() {
    delete start_;
    start_ = nullptr;
  }
  UserFiles() { fs::copy(start_->folder(), place_.folder(), fs::copy_options::recursive); }

  fs::path at(const std::string& name) const { return place_.folder() / name; }

  /// That a command is refused, says so, and has changed nothing.
  void expect_refused(const std::string& arguments, const std::string& message,
                      const std::string& before = "") {
    SCOPED_TRACE(arguments);
    const std::string was = testing::stored(place_.folder());
    const Outcome refused = place_.run(arguments, before);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr(message));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_TRUE(testing::stored(place_.folder()) == was);
  }

  static std::string somebody() {
    return geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  }

  Workplace place_;
  static Workplace* start_;
};

Workplace* UserFiles::start_ = nullptr;

TEST_F(UserFiles, ARecordingInTracesOfTheWorkingFolderStays) {
  fs::create_directory(at("w"));
  place_.file("w/traces/drive.csv", text_of(at("drive.csv")));
  place_.file("w/rec.yaml", "recording: {file: traces/drive.csv}\n");
  expect_refused("detect w/rec.yaml -o w", "w: holds 'rec.yaml' and no report of gapscope");
  fs::rename(at("w/rec.yaml"), at("w.yaml"));
  place_.file("w.yaml", "recording: {file: w/traces/drive.csv}\n");
  expect_refused("detect w.yaml -o w", "w: holds 'traces' and no report of gapscope");
}

TEST_F(UserFiles, AReportOfAnotherDriveIsNotReplaced) {
  ASSERT_EQ(
      place_.run("simulate c.yaml --set simulation.seed=7 --set simulation.noise=1e-5 -o other.csv").status,
      0);
  place_.file("other.yaml", "recording: {file: other.csv}\nmodel: " + std::string(testing::kPaperModel));
  for (const char* command : {"detect", "run", "diagnose"})
    expect_refused(command + std::string(" other.yaml -o r"),
                   "r: holds the report of other data (rec, of drive.csv)");
  expect_refused("detect c.yaml -o r", "r: holds the report of other data (rec, of drive.csv)");
  EXPECT_EQ(place_.run("detect rec.yaml --set recording.window=[0,2.5] -o r").status, 0) << "the same drive";
  ASSERT_EQ(place_.run("detect rec.yaml").status, 0);
  expect_refused("detect other.yaml --set name=rec", "reports/rec: holds the report of other data");
  fs::copy_file(at("other.csv"), at("drive.csv"), fs::copy_options::overwrite_existing);
  expect_refused("detect rec.yaml -o r", "r: holds the report of other data (rec, of drive.csv)");
}

TEST_F(UserFiles, AFolderWithAReportOfTheUsersOwnIsNotTaken) {
  place_.file("user/report.md", "![setup](setup.png)");
  place_.file("user/setup.png", "a photograph");
  place_.file("user/traces/my_measurement.csv", "t,u,x1\n");
  for (const char* command :
       {"run c.yaml", "detect rec.yaml", "fit c.yaml", "diagnose c.yaml", "compare r r"})
    expect_refused(command + std::string(" -o user"), "user: holds ");
}

TEST_F(UserFiles, AReportOfAnotherKindIsNotTaken) {
  place_.file("check.yaml", "name: k\nreport: {first_seed: 9300001, none: 1}\nrigs: [geared]\nduration: 2\n");
  ASSERT_EQ(place_.run("blind run check.yaml -o blind").status, 0);
  expect_refused("detect rec.yaml -o blind", "blind: holds a report of another kind (blind)");
  expect_refused("blind run check.yaml -o r", "r: holds a report of another kind (drive)");
}

TEST_F(UserFiles, WhatTheUserChangedIsHis) {
  place_.file("r/report.md", text_of(at("r/report.md")) + "A word of mine.\n");
  expect_refused("detect rec.yaml -o r", "r: holds 'report.md', which was changed since gapscope wrote it");
  expect_refused("report r", "r: holds 'report.md', which was changed since gapscope wrote it");
}

TEST_F(UserFiles, AResultThatTheUserChangedIsDrawnAndSaidSo) {
  EXPECT_EQ(place_.run("report r").err, "");
  place_.file("r/result.json", text_of(at("r/result.json")) + "\n");
  const std::string said =
      "result.json was changed since gapscope wrote it: the report is of what it says now.";
  for (const char* again : {"once", "once more"}) {
    const Outcome drawn = place_.run("report r");
    EXPECT_EQ(drawn.status, 0) << again;
    EXPECT_THAT(drawn.err, HasSubstr(said)) << again;
    EXPECT_THAT(text_of(at("r/report.md")), HasSubstr("> " + said)) << again;
  }
  EXPECT_THAT(place_.run("compare r r").err, HasSubstr("r: result.json was changed since gapscope wrote it"));
}

TEST_F(UserFiles, APipeAmongTheTracesIsNamed) {
  ASSERT_EQ(mkfifo(at("r/traces/2_pipe.csv").c_str(), 0600), 0);
  const Outcome refused = place_.run("report r");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("r/traces/2_pipe.csv: is no regular file, expected a file of the report"));
}

TEST_F(UserFiles, ANameThatATerminalWouldObeyIsShownHarmlessly) {
  const std::string named =
      "a\x1b[31mb\xc2\x9b"
      "c.csv";
  fs::copy_file(at("drive.csv"), at(named));
  EXPECT_THAT(place_.run("check '" + named + "'").out, HasSubstr("a?[31mb?c.csv\n"));
}

TEST_F(UserFiles, AReportIsNotPutInPlaceOfItsInput) {
  ASSERT_EQ(place_.run("fit c.yaml -o fitted").status, 0);
  expect_refused("run fitted/fitted.yaml -o fitted", "fitted/fitted.yaml: is read, and would be replaced");
}

TEST_F(UserFiles, AFileIsOnlyWrittenOverByTheCommandThatWroteIt) {
  place_.file("mine.yaml", "notes");
  place_.file("mine.csv", "t,u,x1\n0,0,0\n");
  expect_refused("check drive.csv -o mine.yaml", "mine.yaml: is there already, expected another name");
  expect_refused("simulate c.yaml -o mine.csv", "mine.csv: is there already, expected another name");
  expect_refused("init drive.csv -o mine.yaml", "mine.yaml: is there already");
  place_.file("check.yaml", "name: k\nreport: {first_seed: 9300001, none: 1}\nrigs: [geared]\nduration: 2\n");
  expect_refused("blind make check.yaml -o cases --labels mine.yaml",
                 "mine.yaml: is there and holds no labels of k");
  ASSERT_EQ(place_.run("blind make check.yaml -o cases --labels labels.json").status, 0);
  expect_refused("blind answer cases -o mine.yaml", "mine.yaml: is there and holds no answers to k");
  place_.file("own/manifest.json", "{}");
  place_.file("own/labels.json",
              R"({"schema": "gapscope.blind_labels/1", "name": "k", "configuration": null, "cases": []})");
  expect_refused("blind seal own own/labels.json", "own/manifest.json: is there and seals something else");
  for (int again = 0; again < 2; ++again) {
    EXPECT_EQ(place_.run("simulate c.yaml -o new.csv").status, 0);
    EXPECT_NE(place_.run("check drive.csv -o new.json").status, 2);
  }
  place_.file("trace.yaml", "name: again\n" + kThreeSeconds);
  std::string text = text_of(at("trace.yaml"));
  place_.file("trace.yaml", text.replace(text.find("{sine: {amplitude: 0.58, frequency: 1}}"), 39,
                                         "{recorded: {file: new.csv}}"));
  expect_refused("simulate trace.yaml -o new.csv", "new.csv: is the input itself");
}

TEST_F(UserFiles, WhatTheShellHasOpenedIsWrittenAsItWasOpened) {
  for (int again = 0; again < 2; ++again)
    EXPECT_EQ(place_.run("simulate c.yaml -o /dev/fd/7 7>>all.csv").status, 0);
  ASSERT_EQ(place_.run("simulate c.yaml -o one.csv").status, 0);
  EXPECT_EQ(text_of(at("all.csv")), text_of(at("one.csv")) + text_of(at("one.csv")));
  EXPECT_EQ(place_.run("simulate c.yaml -o /dev/fd/7 7<all.csv").status, 1);
  EXPECT_EQ(text_of(at("all.csv")).size(), 2 * text_of(at("one.csv")).size());
}

TEST_F(UserFiles, FilesAsideAreTheUsersUnlessTheyAreGapscopes) {
  place_.file("out.csv.part", "mine");
  fs::create_symlink("drive.csv", at("link.csv"));
  ASSERT_EQ(place_.run("simulate c.yaml -o out.csv").status, 0);
  EXPECT_EQ(text_of(at("out.csv.part")), "mine");
  const Outcome refused = place_.run("simulate c.yaml -o link.csv");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("link.csv: is a link to another file"));
  EXPECT_TRUE(fs::is_symlink(at("link.csv")));
}

TEST_F(UserFiles, AFolderOnAnotherDiskAndOneInAFolderThatIsClosedAreWrittenTo) {
  if (fs::is_directory("/dev/shm")) {
    const fs::path disk = "/dev/shm/gapscope_test_" + std::to_string(getpid());
    fs::create_directory(disk);
    fs::create_directory_symlink(disk, at("link"));
    EXPECT_EQ(place_.run("detect rec.yaml -o link").status, 0);
    EXPECT_TRUE(fs::exists(disk / "result.json"));
    fs::remove_all(disk);
  }
  fs::create_directories(at("closed/own"));
  fs::permissions(place_.folder(), fs::perms::all);
  fs::permissions(at("closed/own"), fs::perms::all);
  fs::permissions(at("closed"), fs::perms(0555));
  EXPECT_EQ(place_.run("detect rec.yaml -o closed/own", somebody()).status, 0);
  EXPECT_TRUE(fs::exists(at("closed/own/result.json")));
  fs::permissions(at("closed"), fs::perms::all);
}

TEST_F(UserFiles, ANameThatIsTooLongIsToldBeforeTheWork) {
  for (const std::size_t length : {300u, 4500u})
    expect_refused("run c.yaml -o " + std::string(length, 'a'), "cannot be written in");
  EXPECT_EQ(place_.run("detect rec.yaml -o " + std::string(250, 'a')).status, 0);
}

TEST_F(UserFiles, AMachineThatIsTooSmallIsToldAndNothingIsLeft) {
  for (const char* limit : {"-n 5", "-v 160000"}) {
    if (std::string(limit).find("-v") != std::string::npos && std::getenv("ASAN_OPTIONS") != nullptr)
      continue;
    const Outcome small = place_.run("detect rec.yaml -o small",
                                     "sh -c 'ulimit " + std::string(limit) + "; exec \"$0\" \"$@\"'");
    EXPECT_NE(small.status, 0) << limit;
    EXPECT_THAT(small.err,
                ::testing::AnyOf(HasSubstr("Too many open files"), HasSubstr("there is not enough memory")))
        << limit;
    EXPECT_FALSE(fs::exists(at("small"))) << limit;
  }
}

TEST_F(UserFiles, WhatIsNoRegularFileIsNotWaitedFor) {
  ASSERT_EQ(mkfifo(at("fifo.yaml").c_str(), 0600), 0);
  const Outcome refused = place_.run("detect fifo.yaml", "timeout -s KILL 20");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("fifo.yaml: is no regular file, expected a configuration"));
  for (const bool folder : {false, true}) {
    fs::remove_all(at("r/traces/bound_map.csv"));
    if (folder)
      fs::create_directory(at("r/traces/bound_map.csv"));
    else
      ASSERT_EQ(mkfifo(at("r/traces/bound_map.csv").c_str(), 0600), 0);
    const Outcome report = place_.run("report r", "timeout -s KILL 20");
    EXPECT_EQ(report.status, 2);
    EXPECT_THAT(report.err, ::testing::StartsWith("r/traces/bound_map.csv: is no regular file"));
  }
}

TEST_F(UserFiles, NumbersOfTheCommandLineAndNamesInAConfigurationAreSound) {
  expect_refused("check drive.csv --resample nan", "--resample: expected a number from");
  expect_refused("check drive.csv --window nan 2", "--window: expected a number from");
  expect_refused("detect --stream --quantum nan", "--quantum: expected a number from");
  expect_refused("detect --stream --quantum 0x1p-10", "--quantum: expected a number from");
  expect_refused("check drive.csv --gear-ratio 0x10", "--gear-ratio: expected 1e-6 to 1e6");
  expect_refused("detect --stream --position t", "name one column twice, expected three columns");
  place_.file("nul.yaml", "recording: {file: \"drive.csv\\0x\"}\n");
  expect_refused("detect nul.yaml",
                 "nul.yaml:1: recording.file is 'drive.csv?x', expected a text without control");
}

TEST_F(UserFiles, AFileThatMayBeCutOffIsTold) {
  const std::string whole = text_of(at("drive.csv"));
  place_.file("drive.csv", whole.substr(0, whole.size() - 4));
  EXPECT_THAT(place_.run("check drive.csv").out, HasSubstr("the last line has no end"));
  ASSERT_EQ(place_.run("detect rec.yaml -o cut").status, 0);
  EXPECT_THAT(text_of(at("cut/report.md")), HasSubstr("its last line has no end"));
}

TEST_F(UserFiles, AReportIsOfOneDrive) {
  ASSERT_EQ(place_.run("simulate c.yaml --set simulation.noise=1e-5 -o held.csv").status, 0);
  place_.file("d.yaml", "name: rig\nrecording: {file: drive.csv, held_out: held.csv}\nmodel: " +
                            std::string(testing::kPaperModel));
  const std::string most = testing::excluding_all_but({"input_delay"});
  ASSERT_EQ(place_.run("diagnose d.yaml -o both" + most).status, 0);
  ASSERT_EQ(place_.run("detect d.yaml -o both").status, 0);
  EXPECT_TRUE(fs::exists(at("both/diagnosis.json"))) << "of the same files";
  for (const char* asked : {"detector.bound=40", "detector.method=lost_motion", "diagnosis.detectable=true",
                            "tolerance.gap=1e-3"}) {
    ASSERT_EQ(place_.run("detect d.yaml -o both --set " + std::string(asked)).status, 0) << asked;
    EXPECT_TRUE(fs::exists(at("both/diagnosis.json"))) << "has nothing to do with " << asked;
  }
  place_.file("d.yaml", text_of(at("d.yaml")) + "encoder: {bits: 18}\n");
  const Outcome detected = place_.run("detect d.yaml -o both");
  EXPECT_THAT(detected.err, HasSubstr("The diagnosis in this folder was dropped, as it was made from "
                                      "another configuration."));
  EXPECT_FALSE(fs::exists(at("both/diagnosis.json")));
  EXPECT_THAT(text_of(at("both/report.md")), HasSubstr("> The diagnosis in this folder was dropped"));
  ASSERT_EQ(place_.run("report both").status, 0);
  EXPECT_THAT(text_of(at("both/report.md")), HasSubstr("> The diagnosis in this folder was dropped"));
  place_.file("drive.csv", text_of(at("drive.csv")) + "# another copy\n");
  const Outcome diagnosed = place_.run("diagnose d.yaml -o both" + most);
  EXPECT_THAT(diagnosed.err, HasSubstr("The estimate in this folder was dropped, as it was made from "
                                       "another drive.csv."));
  EXPECT_FALSE(fs::exists(at("both/result.json")));
}

TEST_F(UserFiles, EveryFolderListsWhatIsInIt) {
  place_.file("campaign.yaml",
              "name: k\naxes: {encoder.bits: [16, 18]}\nestimators: [model_free]\nbase: c.yaml\n");
  ASSERT_EQ(place_.run("campaign campaign.yaml -o k").status, 0);
  ASSERT_EQ(place_.run("compare r r -o same").status, 0);
  ASSERT_EQ(place_.run("blind drives --seeds 7..8 -o drives").status, 0);
  for (const char* folder : {"r", "k", "same", "drives"}) {
    std::set<std::string> listed = {"files.json"}, there;
    const auto list = nlohmann::json::parse(text_of(at(folder) / "files.json"));
    for (const auto& file : list["files"]) listed.insert(file["file"].get<std::string>());
    for (const auto& entry : fs::recursive_directory_iterator(at(folder)))
      if (entry.is_regular_file()) there.insert(entry.path().lexically_relative(at(folder)).string());
    EXPECT_EQ(listed, there) << folder;
  }
}

TEST_F(UserFiles, WhatIsNamedWronglyIsRefusedAndAStreamHoldsTheRecordingAlone) {
  EXPECT_THAT(place_.run("detect rec.yaml -o ''").err, HasSubstr("--output: is empty"));
  EXPECT_THAT(place_.run("check drive.csv --time t --input t").err, HasSubstr("name one column twice"));
  const Outcome streamed = place_.run("simulate c.yaml -o /dev/stdout");
  ASSERT_EQ(streamed.status, 0) << streamed.err;
  EXPECT_THAT(streamed.out, ::testing::StartsWith("t,u,x1"));
  EXPECT_EQ(streamed.out.find("samples"), std::string::npos);
}

}  // namespace
}  // namespace gapscope
