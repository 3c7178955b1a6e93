#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>

#include "cli/executable.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::kPaperModel;
using ::testing::StartsWith;
using testing::text_of;
using testing::Workplace;

// The paper's rig for two seconds at a coarse rate: a run takes some hundredths of a second.
const std::string kBase = R"(base:
  encoder: {bits: 18}
  simulation:
    rate: 1000
    duration: 2
    excitation: {sine: {amplitude: 0.58, frequency: 1}}
    noise: 1.0e-5
  model: )" + kPaperModel;

std::string over(const std::string& axes) { return "name: small\naxes: " + axes + "\n" + kBase; }

/// A campaign of the given number of runs in c.yaml.
Workplace& with_campaign(Workplace& place, int repeats) {
  place.file("c.yaml",
             over("{encoder.bits: [14, 16, 20], simulation.rate: [500, 1000], simulation.seed: {repeat: " +
                  std::to_string(repeats) + "}}"));
  return place;
}

std::string exported(const Workplace& place, const std::string& folder) {
  const auto out = place.run("campaign export " + folder);
  EXPECT_EQ(out.status, 0) << out.err;
  return out.out;
}

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Campaign, WritesAStoreAReportAndWhatIsNeeded) {
  Workplace place;
  const auto run = with_campaign(place, 1).run("campaign c.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(
      run.out,
      AllOf(HasSubstr("reports/small/results.sqlite"), HasSubstr("runs        6 (6 of them now)"),
            HasSubstr("\nTake the fitted model, given "), HasSubstr("\nThat costs, in passes over ")));
  const auto content = place.content();
  for (const char* file :
       {"report.md", "campaign.json", "timing.json", "cost.png", "map_2_1.png", "along_1.png", "along_2.png"})
    EXPECT_TRUE(content.count(std::string("reports/small/") + file)) << file;
}

TEST(Campaign, ItsReportIsDrawnAgainFromTheSummaryAlone) {
  Workplace place;
  ASSERT_EQ(with_campaign(place, 1).run("campaign c.yaml -o r").status, 0);
  const std::string before = text_of(place.folder() / "r/report.md"),
                    map = text_of(place.folder() / "r/map_2_1.png");
  std::filesystem::remove(place.folder() / "r/results.sqlite");
  std::filesystem::remove(place.folder() / "r/report.md");
  std::filesystem::remove(place.folder() / "r/map_2_1.png");
  ASSERT_EQ(place.run("report r").status, 0);
  EXPECT_EQ(text_of(place.folder() / "r/report.md"), before);
  EXPECT_EQ(text_of(place.folder() / "r/map_2_1.png"), map);
}

TEST(Campaign, ADryRunTellsNumberTimeAndConfigurationsAndWritesNothing) {
  Workplace place;
  const auto run = with_campaign(place, 50).run("campaign c.yaml --dry-run -j 1");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(StartsWith("runs        300\ntime        about "), HasSubstr("on 1 threads"),
                             HasSubstr("name: \"small_run_3\""), ::testing::Not(HasSubstr("small_run_4"))));
  EXPECT_EQ(place.content().size(), 1u);
}

// interrupt.sh SIGNAL FOLDER COMMAND...: sends the signal when five more runs are stored in the folder.
const std::string kInterrupt = R"(signal=$1 folder=$2
shift 2
stored() { "$1" campaign export "$2" 2>/dev/null | wc -l; }
before=$(stored "$1" $folder)
"$@" &
pid=$!
while kill -0 $pid 2>/dev/null && [ $(stored "$1" $folder) -lt $((before + 5)) ]; do sleep 0.02; done
kill -$signal $pid
wait $pid
)";

TEST(Campaign, KilledThreeTimesItEndsWithTheSameBytesAsNever) {
  Workplace place;
  with_campaign(place, 20).file("interrupt.sh", kInterrupt);
  for (int i = 0; i < 3; ++i) {
    const auto killed = place.run("campaign c.yaml -o killed -j 2", "sh interrupt.sh KILL killed");
    EXPECT_EQ(killed.status, 128 + 9);
  }
  const long survived = lines(exported(place, "killed")) - 1;
  EXPECT_GE(survived, 14);
  EXPECT_LT(survived, 120);
  const auto last = place.run("campaign c.yaml -o killed -j 2");
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.out, HasSubstr("120 (" + std::to_string(120 - survived) + " of them now)"));
  ASSERT_EQ(place.run("campaign c.yaml -o whole -j 1").status, 0);
  EXPECT_EQ(exported(place, "killed"), exported(place, "whole"));
  EXPECT_EQ(text_of(place.folder() / "killed/campaign.json"),
            text_of(place.folder() / "whole/campaign.json"));
}

TEST(Campaign, CtrlCIsAnsweredAndKeepsWhatIsDone) {
  Workplace place;
  with_campaign(place, 1000).file("interrupt.sh", kInterrupt);
  const auto stopped = place.run("campaign c.yaml -o stopped", "sh interrupt.sh INT stopped");
  EXPECT_EQ(stopped.status, 130);
  EXPECT_THAT(stopped.err, EndsWith("gapscope: interrupted\n"));
  EXPECT_GE(lines(exported(place, "stopped")), 5);
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "stopped/report.md"));
}

TEST(Campaign, ThreeShardsMergedExportWhatTheWholeExports) {
  Workplace place;
  with_campaign(place, 2);
  for (const std::string k : {"1", "2", "3"}) {
    const auto shard = place.run("campaign c.yaml -o shard" + k + " --shard " + k + "/3");
    ASSERT_EQ(shard.status, 0) << shard.err;
    EXPECT_THAT(shard.out, HasSubstr("runs        4 (4 of them now)"));
  }
  const auto merged = place.run("campaign merge shard2 shard3 shard1 -o merged");
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_THAT(merged.out, HasSubstr("12 of 12"));
  ASSERT_EQ(place.run("campaign c.yaml -o whole").status, 0);
  EXPECT_EQ(exported(place, "merged"), exported(place, "whole"));
  EXPECT_EQ(text_of(place.folder() / "merged/report.md"), text_of(place.folder() / "whole/report.md"));
}

TEST(Campaign, AMissingShardIsMadeGoodByTheSameCommand) {
  Workplace place;
  with_campaign(place, 2);
  for (const std::string k : {"1", "3"})
    ASSERT_EQ(place.run("campaign c.yaml -o shard" + k + " --shard " + k + "/3").status, 0);
  EXPECT_THAT(place.run("campaign merge shard1 shard3 -o merged").out, HasSubstr("8 of 12"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "merged/report.md"));
  EXPECT_THAT(place.run("campaign c.yaml -o merged").out, HasSubstr("12 (4 of them now)"));
}

TEST(Campaign, ARefusedMergeLeavesNothing) {
  Workplace place;
  with_campaign(place, 2);
  for (const std::string k : {"1", "2"})
    ASSERT_EQ(place.run("campaign c.yaml -o shard" + k + " --shard " + k + "/2").status, 0);
  std::filesystem::copy(place.folder() / "shard1", place.folder() / "other",
                        std::filesystem::copy_options::recursive);
  sqlite3* store = nullptr;
  ASSERT_EQ(sqlite3_open((place.folder() / "other/results.sqlite").c_str(), &store), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(store, "UPDATE runs SET model_free_gap_rad = 1", nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(store);
  const auto refused = place.run("campaign merge shard1 other shard2 -o merged");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("other: has another result for run 1"));
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "merged"));
  EXPECT_EQ(place.run("campaign merge shard1 shard2 -o merged").status, 0);
}

TEST(Campaign, AnArchiveThatCannotBeWrittenIsExported) {
  namespace fs = std::filesystem;
  Workplace place;
  with_campaign(place, 1);
  ASSERT_EQ(place.run("campaign c.yaml -o k").status, 0);
  const std::string whole = exported(place, "k");
  fs::permissions(place.folder() / "k/results.sqlite", fs::perms(0444));
  fs::permissions(place.folder() / "k", fs::perms(0555));
  const std::string somebody =
      geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : std::string();
  const auto archive = place.run("campaign export k", somebody);
  EXPECT_EQ(archive.status, 0) << archive.err;
  EXPECT_EQ(archive.out, whole);
  fs::permissions(place.folder() / "k", fs::perms::owner_all);
}

TEST(Campaign, AStoreOfAnotherCampaignIsRefusedAndStays) {
  Workplace place;
  ASSERT_EQ(with_campaign(place, 1).run("campaign c.yaml -o r").status, 0);
  const std::string before = exported(place, "r");
  place.file("other.yaml", over("{encoder.bits: [14, 16, 18], simulation.rate: [500, 1000]}"));
  const auto refused = place.run("campaign other.yaml -o r");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("it has 'axis encoder.bits: 14, 16, 20'"),
                                 HasSubstr("expected 'axis encoder.bits: 14, 16, 18'")));
  EXPECT_EQ(exported(place, "r"), before);
}

TEST(Campaign, WrongCommandLinesAreToldAndWriteNothing) {
  Workplace place;
  with_campaign(place, 1);
  const std::pair<std::string, std::string> wrong[] = {
      {"campaign", "CONFIG is required"},
      {"campaign nowhere.yaml", "there is no such file"},
      {"campaign c.yaml --shard 4/3", "--shard is '4/3', expected K/N"},
      {"campaign c.yaml --shard 0/3", "--shard is '0/3'"},
      {"campaign c.yaml --shard two", "--shard is 'two'"},
      {"campaign c.yaml -j 0", "expected gapscope campaign"},
      {"campaign export nowhere", "nowhere/results.sqlite: there is no such file"},
      {"campaign merge nowhere -o r", "nowhere/results.sqlite: there is no such file"},
      {"campaign merge nowhere", "-o"}};
  for (const auto& [arguments, message] : wrong) {
    const auto run = place.run(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, AllOf(HasSubstr(message), HasSubstr("expected"))) << arguments;
    EXPECT_EQ(place.content().size(), 1u) << arguments;
  }
}

TEST(Campaign, ATrillionRunsAreRefusedWithTheirNumber) {
  Workplace place;
  place.file(
      "c.yaml",
      over("{simulation.rate: {range: [500, 1000], count: 1000000}, simulation.seed: {repeat: 1000000}}"));
  const auto run = place.run("campaign c.yaml --dry-run");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("1000000000000 runs"));
}

bool has_slurm() {
  return std::system(
             "command -v munged slurmctld slurmd sbatch >/dev/null 2>&1 && "
             "[ $(for c in munged slurmctld slurmd sbatch; do command -v $c; done | wc -l) = 4 ]") == 0;
}

TEST(Campaign, AJobArrayOnARealSlurmGivesWhatTheWholeGives) {
  if (!has_slurm()) GTEST_SKIP() << "no Slurm on this host (Debian: slurm-wlm, munge)";
  Workplace place;
  with_campaign(place, 2);
  const std::string source = GAPSCOPE_SOURCE_DIR;
  const std::string script = source + "/configs/slurm/campaign_array.sh";
  const std::string command =
      "cd " + place.folder().string() + " && GAPSCOPE=" + GAPSCOPE_EXECUTABLE + " timeout 120 " + source +
      "/tests/cli/slurm_host.sh " + (place.folder() / "slurm").string() +
      " sbatch --wait --array=1-3 -o task_%a.out " + script + " c.yaml array >slurm.out 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0)
      << text_of(place.folder() / "slurm.out") << text_of(place.folder() / "slurm/slurmctld.log");
  const auto merged = place.run("campaign merge array/shard_1 array/shard_2 array/shard_3 -o merged");
  ASSERT_EQ(merged.status, 0) << merged.err;
  ASSERT_EQ(place.run("campaign c.yaml -o whole").status, 0);
  EXPECT_EQ(exported(place, "merged"), exported(place, "whole"));
}

}  // namespace
}  // namespace gapscope
