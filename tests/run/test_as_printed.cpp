// `detector: {method: literal}` against a second writing of S1 to S6 in another language.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "gapscope/recording/recording_file.h"
#include "gapscope/sliding_mode/detector.h"
#include "results/scratch_folder.h"
#include "run/against_the_paper.h"
#include "run/run_pipeline.h"
#include "support/reading.h"

namespace gapscope {
namespace {

const std::string kProject = GAPSCOPE_SOURCE_DIR;

Recording recording_of(const std::string& configuration) {
  Recording recording = simulated_recording(load_configuration(kProject + "/configs/" + configuration));
  recording.quantum = 2.0 * kPi / 1048576.0;
  return recording;
}

GapEstimate read_as_printed(const Recording& recording, double bound) {
  const MotorTrace trace = recording.motor_trace();
  return detect_gap({&trace, 1}, {.method = DetectorMethod::kLiteral, .bound = bound});
}

struct Passage {
  double t1 = kNaN, t2 = kNaN, gap = kNaN;
};

/// What the script says of a file; `there` is false where no Python is.
std::vector<Passage> by_script(const std::string& csv, double bound, double quantum, bool& there) {
  std::ostringstream command;
  command.precision(17);
  command << "python3 " << kProject << "/tests/run/as_printed.py " << csv << " " << bound << " " << quantum
          << " >" << csv << ".out";
  const int status = std::system(command.str().c_str());
  there = WEXITSTATUS(status) != 127;
  EXPECT_TRUE(!there || status == 0) << command.str();
  std::istringstream lines(testing::text_of(csv + ".out"));
  std::vector<Passage> passages;
  for (Passage p; lines >> p.t1 >> p.t2 >> p.gap;) passages.push_back(p);
  return passages;
}

class AsPrinted : public ::testing::TestWithParam<const char*> {};

TEST_P(AsPrinted, IsWhatASecondWritingInAnotherLanguageReadsToTheSample) {
  const ScratchFolder folder;
  const Recording recording = recording_of(GetParam());
  const std::string csv = (folder.path / "drive.csv").string();
  write_csv(csv, recording);
  std::size_t read = 0;
  for (const double bound : {3.0, 4.0, 6.0, 40.0, 100.0}) {
    bool there = false;
    const std::vector<Passage> expected = by_script(csv, bound, recording.quantum, there);
    if (!there) GTEST_SKIP() << "no python3 here";
    const std::vector<GapEvent> events = read_as_printed(recording, bound).events;
    ASSERT_EQ(events.size(), expected.size()) << bound;
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_NEAR(events[i].t1, expected[i].t1, 0.1 * recording.dt) << bound;
      EXPECT_NEAR(events[i].t2, expected[i].t2, 0.1 * recording.dt) << bound;
      EXPECT_NEAR(events[i].gap, expected[i].gap, 1e-12) << bound;
    }
    read += events.size();
  }
  EXPECT_GE(read, 50u);
}

INSTANTIATE_TEST_SUITE_P(Configurations, AsPrinted,
                         ::testing::Values("02_experiment.yaml", "12_paper_experiment.yaml"));

/// Made by study_against_the_paper.
TEST(PaperExperiment, StandsBesideThePaperInTheDocumentsAsItIs) {
  const std::string page = testing::text_of(kProject + "/docs/against_the_paper.md");
  const std::string table = test::against_the_paper();
  EXPECT_NE(page.find(table), std::string::npos) << "now:\n" << table;
}

TEST(PaperExperiment, IsReadWithTheBoundOfThePaper) {
  const Recording recording = recording_of("12_paper_experiment.yaml");
  const GapEstimate estimate = read_as_printed(recording, 40.0);
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.reason;
  const auto near = std::ranges::count_if(
      estimate.events, [](const GapEvent& e) { return std::abs(e.gap / 0.019 - 1.0) < 0.05; });
  EXPECT_GE(near, 15);
  EXPECT_NEAR(estimate.gap, 0.019, 0.05 * 0.019);
  EXPECT_EQ(read_as_printed(recording, 100.0).verdict, GapVerdict::kInconclusive);
}

}  // namespace
}  // namespace gapscope
