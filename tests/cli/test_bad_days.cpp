// What goes wrong in daily use: a full disk, a folder that cannot be written, a recording that goes away,
// Ctrl-C and kill -9 at any moment, two commands at one store. A clear error, nothing half-written, nothing
// lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <sstream>
#include <vector>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::text_of;
using testing::Workplace;

const std::string kSimulation =
    "encoder: {bits: 18}\n"
    "simulation: {rate: 500, duration: 2, excitation: {sine: {amplitude: 0.58, frequency: 1}}}\n"
    "model: " +
    testing::kPaperModel;
const std::string kCampaign =
    "axes: {encoder.bits: [14, 16, 20], simulation.seed: {repeat: 100}}\nestimators: [model_free]\n"
    "base:\n  encoder: {bits: 18}\n"
    "  simulation: {rate: 500, duration: 2, excitation: {sine: {amplitude: 0.58, frequency: 1}}}\n"
    "  model: " +
    testing::kPaperModel;
constexpr const char* kCheck =
    "name: check\nreport: {first_seed: 9300001, none: 2}\nrigs: [geared]\nduration: 2\n";

/// A workplace with a recording, a campaign and a blind check.
class BadDay : public ::testing::Test {
 protected:
  BadDay() {
    place_.file("c.yaml", "name: rig\n" + kSimulation);
    place_.file("campaign.yaml", kCampaign);
    place_.file("check.yaml", kCheck);
    EXPECT_EQ(place_.run("simulate c.yaml -o d.csv").status, 0);
  }

  /// Two reports, for those that read or replace one.
  void make_reports() {
    ASSERT_EQ(place_.run("run c.yaml -o r").status, 0);
    fs::copy(place_.folder() / "r", place_.folder() / "older", fs::copy_options::recursive);
  }

  /// Every file but hidden ones, files aside and wall times.
  static std::map<std::string, std::string> visible(const Workplace& place) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(place.folder())) {
      const std::string name = entry.path().lexically_relative(place.folder()).string();
      const bool aside = name.find("/.") != name.npos || name[0] == '.' || name.ends_with(".part");
      if (entry.is_regular_file() && !aside && !name.ends_with("timing.json"))
        files[name] = text_of(entry.path());
    }
    return files;
  }

  Workplace place_;
};

TEST_F(BadDay, AFullDiskIsToldAndWhatWasThereStays) {
  const std::pair<const char*, int> commands[] = {// with how many blocks of 512 bytes there are left
                                                  {"run c.yaml -o r", 1},
                                                  {"run c.yaml -o r", 100},
                                                  {"detect c.yaml -o new", 1},
                                                  {"simulate c.yaml -o d.csv", 1},
                                                  {"report r", 1},
                                                  {"report r", 200},
                                                  {"compare r older -o both", 1},
                                                  {"compare r older -o both", 20},
                                                  {"init d.csv -o i.yaml", 1},
                                                  {"check d.csv -o findings.json", 1},
                                                  {"blind make check.yaml -o cases --labels labels.json", 1}};
  make_reports();
  const auto before = visible(place_);
  for (const auto& [command, blocks] : commands) {
    SCOPED_TRACE(std::string(command) + " with " + std::to_string(blocks));
    const Outcome full = place_.run(command, "ulimit -f " + std::to_string(blocks) + ";");
    EXPECT_EQ(full.status, 1);
    EXPECT_THAT(full.err, HasSubstr("cannot be written"));
    EXPECT_THAT(full.err, Not(HasSubstr("/.")));  // a hidden folder
    EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
    EXPECT_TRUE(visible(place_) == before);
  }
  for (const std::string& name : place_.content()) EXPECT_THAT(name, Not(HasSubstr("part"))) << "left behind";
}

TEST_F(BadDay, AFullDiskEndsACampaignWhichGoesOnWhenThereIsRoom) {
  const Outcome full = place_.run("campaign campaign.yaml -o c -j 2", "ulimit -f 200;");
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err, HasSubstr("c/results.sqlite: "));
  const Outcome kept = place_.run("campaign export c");
  ASSERT_EQ(kept.status, 0) << kept.err;
  ASSERT_EQ(place_.run("campaign campaign.yaml -o c -j 2").status, 0);
  ASSERT_EQ(place_.run("campaign campaign.yaml -o never -j 2").status, 0);
  EXPECT_EQ(place_.run("campaign export c").out, place_.run("campaign export never").out);
}

TEST_F(BadDay, AStandardOutputThatIsFullIsAFailure) {
  const Outcome full = place_.run("effects", "sh -c '\"$0\" \"$@\" >/dev/full'");
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err, HasSubstr("standard output cannot be written"));
}

TEST_F(BadDay, AFolderThatCannotBeWrittenIsToldBeforeTheWork) {
  make_reports();
  fs::create_directory(place_.folder() / "closed");
  fs::permissions(place_.folder(), fs::perms::all);
  fs::permissions(place_.folder() / "closed", fs::perms(0555));
  const std::string somebody =
      geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : std::string();
  for (const char* command : {"run c.yaml -o closed/new", "run c.yaml -o closed",
                              "diagnose c.yaml -o closed/a/b", "campaign campaign.yaml -o closed/c",
                              "blind run check.yaml -o closed/b", "compare r older -o closed/c"}) {
    const Outcome refused = place_.run(command, somebody);
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_THAT(refused.err, HasSubstr("closed: cannot be written in, expected a writable folder"))
        << command;
  }
  EXPECT_EQ(place_.run("simulate c.yaml -o closed/d.csv", somebody).status, 1);
  EXPECT_TRUE(fs::is_empty(place_.folder() / "closed"));
}

TEST_F(BadDay, NothingIsWrittenOutsideTheFolderThatWasNamed) {
  place_.file("in/c.yaml", "name: rig\nrecording: {file: ../d.csv}\nmodel: " + testing::kPaperModel);
  auto expected = place_.content();
  const Outcome run = place_.run("run in/c.yaml -o in/out");
  ASSERT_EQ(run.status, 0) << run.err;
  auto content = place_.content();
  std::erase_if(content, [](const std::string& name) { return name.starts_with("in/out"); });
  EXPECT_EQ(content, expected);
}

/// What is to be killed at several moments of its time.
struct Work {
  const char* name;
  std::string arguments;
  int moments;
  bool of_reports = false;  ///< reads or replaces one
  bool goes_on = false;     ///< keeps what it has for the next time
};

class KilledWork : public BadDay, public ::testing::WithParamInterface<int> {
 protected:
  static Work work() {
    switch (GetParam()) {
      case 0:
        return {"run", "run c.yaml -o r", 2, true};
      case 1:
        return {"diagnose", "diagnose c.yaml -o r" + testing::excluding_all_but({"actuator_lag"}), 2, true};
      case 2:
        return {"report", "report r", 2, true};
      case 3:
        return {"compare", "compare r older -o both", 2, true};
      case 4:
        return {"init", "init d.csv -o i.yaml", 3};
      case 5:
        return {"simulate", "simulate c.yaml -o d.csv", 3};
      default:
        return {"blind", "blind run check.yaml -o b -j 1", 4, false, true};
    }
  }

  using Files = std::map<std::string, std::string>;

  /// Each file as one of the states has it: the moment in which they are moved in one after the other is
  /// short, and its list names both.
  static void expect_one_of(const Files& found, const std::vector<Files>& allowed) {
    for (const auto& [name, bytes] : found)
      EXPECT_TRUE(name.ends_with("files.json") || std::any_of(allowed.begin(), allowed.end(),
                                                              [&](const Files& state) {
                                                                const auto at = state.find(name);
                                                                return at != state.end() &&
                                                                       at->second == bytes;
                                                              }))
          << name << " is something in between";
  }
  /// What a first Ctrl-C kept of a diagnosis, or of a run whose model was still fitted.
  static bool says_that_it_was_stopped(const Files& found) {
    const auto says = [&](const char* file, const char* words) {
      const auto stored = found.find(file);
      return stored != found.end() && stored->second.find(words) != std::string::npos;
    };
    return says("r/diagnosis.json", "\"search\": \"stopped\"") ||
           says("r/result.json", "the fit of the model was stopped");
  }
};

TEST_P(KilledWork, LeavesTheOldOrTheNewAndIsDoneByTheSameCommand) {
  const Work w = work();
  if (w.of_reports) make_reports();
  const auto before = visible(place_);
  const Workplace whole;
  fs::copy(place_.folder(), whole.folder(), fs::copy_options::recursive);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(whole.run(w.arguments).status, 0);
  const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto after = visible(whole);
  std::vector<Files> allowed = {before, after};
  for (int k = 0; k < w.moments; ++k) {
    const std::string at = std::to_string(time * (k + 0.5) / w.moments);
    place_.run(w.arguments, "timeout --foreground -s KILL " + at);
    if (!w.goes_on) expect_one_of(visible(place_), allowed);
    const Outcome stopped = place_.run(w.arguments, "timeout --foreground --preserve-status -s INT " + at);
    EXPECT_THAT(stopped.status, AnyOf(Eq(130), Eq(0), Eq(2)));  // 2: init overwrites nothing
    if (says_that_it_was_stopped(visible(place_))) allowed.push_back(visible(place_));
    if (!w.goes_on) expect_one_of(visible(place_), allowed);
  }
  place_.run(w.arguments);
  EXPECT_TRUE(visible(place_) == after);
}

INSTANTIATE_TEST_SUITE_P(Of, KilledWork, ::testing::Range(0, 7));

TEST_F(BadDay, WhatWasKilledWhileItWasMarkedGoesAndWhatIsMarkedOtherwiseStays) {
  make_reports();
  for (const char* mark : {"", "A report that is be"}) {
    place_.file("both/.gapscope-partial-abcdef/.made-by-gapscope", mark);
    EXPECT_EQ(place_.run("compare r older -o both").status, 0) << "'" << mark << "'";
    EXPECT_FALSE(place_.content().contains("both/.gapscope-partial-abcdef"));
    fs::remove_all(place_.folder() / "both");
  }
  place_.file("both/.gapscope-partial-abcdef/.made-by-gapscope", "mine");
  EXPECT_EQ(place_.run("compare r older -o both").status, 2);
  place_.file("both/.gapscope-partial-abcdef/.made-by-gapscope", "");
  place_.file("both/.gapscope-partial-abcdef/photo.png", "mine");
  EXPECT_EQ(place_.run("compare r older -o both").status, 2);
  EXPECT_TRUE(place_.content().contains("both/.gapscope-partial-abcdef/photo.png"));
}

TEST_F(BadDay, WhatAKilledReportLeftGoesWithTheNextOne) {
  make_reports();
  const std::string left = "r/.gapscope-partial-abcdef";
  place_.file(left + "/.made-by-gapscope",
              "A report that is being written; may be removed when nobody writes it.\n");
  place_.file(left + "/result.json", "{");
  place_.file(".r.partial-MyBackup/photo.png", "mine");
  ASSERT_EQ(place_.run("report r").status, 0);
  const auto content = place_.content();
  EXPECT_FALSE(content.contains(left));
  EXPECT_TRUE(content.contains(".r.partial-MyBackup/photo.png"));
}

// first.sh FIRST SECOND: both are the command; the second one begins when the first has stored something, and
// is the one whose status and messages count.
constexpr const char* kFirst = R"(exe=$0; first=$1; there=$2; shift 2
$exe $first >first.out 2>first.err &
pid=$!
while kill -0 $pid && ! [ -s $there ]; do sleep 0.02; done 2>/dev/null
"$@"
status=$?
kill -INT $pid; wait $pid
exit $status
)";

TEST_F(BadDay, ASecondCampaignOnTheSameStoreIsRefused) {
  place_.file("first.sh", kFirst);
  const std::string exe = GAPSCOPE_EXECUTABLE;
  const Outcome second =
      place_.run("campaign campaign.yaml -o c",
                 "sh -c \"$(cat first.sh)\" " + exe + " 'campaign campaign.yaml -o c -j 1' c/results.sqlite");
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("c: is being written by another process, expected one at a time"));
  EXPECT_THAT(text_of(place_.folder() / "first.err"), HasSubstr("interrupted"));
  EXPECT_EQ(place_.run("campaign export c").status, 0);
}

TEST_F(BadDay, ARecordingThatGoesAwayEndsItsCampaignWithoutAResult) {
  place_.file("recorded.yaml",
              "axes: {detector.bound: {range: [20, 60], count: 150}}\nestimators: [model_free]\n"
              "base:\n  recording: {file: d.csv}\n  model: " +
                  testing::kPaperModel);
  const std::string take_away =
      "sh -c '\"$0\" \"$@\" & pid=$!; while ! [ -s c/results.sqlite-wal ]; do sleep 0.02; done; mv d.csv "
      "gone; wait $pid'";
  const Outcome without = place_.run("campaign recorded.yaml -o c -j 2", take_away);
  EXPECT_EQ(without.status, 1);
  EXPECT_THAT(without.err, HasSubstr("a recording changed while the campaign ran"));
  fs::rename(place_.folder() / "gone", place_.folder() / "d.csv");
  ASSERT_EQ(place_.run("campaign recorded.yaml -o c -j 2").status, 0);
  ASSERT_EQ(place_.run("campaign recorded.yaml -o never -j 2").status, 0);
  EXPECT_EQ(place_.run("campaign export c").out, place_.run("campaign export never").out);
}

}  // namespace
}  // namespace gapscope
