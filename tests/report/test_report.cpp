#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>

#include "gapscope/base/errors.h"
#include "report/markdown.h"
#include "report/report.h"
#include "report/sample_run.h"
#include "results/scratch_folder.h"
#include "support/png_file.h"
#include "support/reading.h"
#include "telling/answer.h"

namespace gapscope {
namespace {

using internal::report::estimate_text;
using internal::report::warnings_of;
using testing::text_of;
namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Report, EveryFigureOfAFullRunIsThereAndNotBlank) {
  ScratchFolder scratch;
  write_run_result(scratch.path.string(), sample_run({.samples = 9000}));
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  for (const char* name : {"overview.png", "fig2_input_and_displacement.png", "fig3_backlash_map.png",
                           "fig4_backlash_state_and_input.png", "fig5_displacement_and_error.png",
                           "fig6_one_period.png", "estimates.png", "residuals.png"}) {
    const cv::Mat image = testing::picture_of((scratch.path / name).string());
    EXPECT_EQ(image.cols, std::string(name) == "overview.png" ? 2400 : 1600) << name;
    EXPECT_GT(image.rows, 400) << name;
    EXPECT_TRUE(has(text, "](" + std::string(name) + ")")) << name << " is not in report.md";
    cv::Scalar centre, spread;
    cv::meanStdDev(image, centre, spread);
    EXPECT_GT(spread[0], 10.0) << name << " is blank";
  }
  EXPECT_TRUE(has(text, "## Estimates of the gap\n\nWithout a model: backlash gap 18.91 mrad"));
  EXPECT_TRUE(has(text, "| `gap` | 18.828 ± 0.029 mrad | yes |"));
  EXPECT_TRUE(has(text, "## Warnings\n\n- The load turned on"));
}

TEST(Report, SaysNearTheTopThatNoDriveMadeTheDataAndListsThePassages) {
  ScratchFolder scratch;
  RunResult run = sample_run({.samples = 6000});
  run.simulated_data = {"The data are simulated."};
  const std::size_t passages = run.model_free->events.size();
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  EXPECT_LT(text.find("> The data are simulated."), text.find("- **Gap:**"));
  const std::size_t table = text.find("## Passages of the gap");
  ASSERT_NE(table, std::string::npos);
  const std::string rows = text.substr(table, text.find("\n## ", table + 1) - table);
  EXPECT_EQ(static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')), passages + 6);
  EXPECT_TRUE(has(text, "`gapscope diagnose CONFIG`"));
  EXPECT_FALSE(has(text, "- **Cause:** "));
}

TEST(Report, ListsNoPassageWithoutABeginAndNoGapOfOneThatWasSetAside) {
  ScratchFolder scratch;
  RunResult run = sample_run({.samples = 6000});
  std::vector<GapEvent>& events = run.model_free->events;
  events[0].accepted = false, events[0].gap = 0.357, events[0].remark = "the load was moving";
  events[1].accepted = false, events[1].t1 = events[1].x1_t1 = events[1].gap = kNaN;
  events[1].remark = "the load drove the motor at the impact";
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  EXPECT_FALSE(has(text, "357"));
  EXPECT_TRUE(has(text, " | – | – | no: the load was moving |"));
  EXPECT_TRUE(has(text, "| yes |"));
  EXPECT_TRUE(has(
      text, "\n1 impact without a begin t1 (the load drove the motor at the impact) is in `result.json`.\n"));
  EXPECT_FALSE(has(text, "nan"));
}

TEST(Report, OfAnInconclusiveDetectionSaysWhyAndWhatIsLeftOut) {
  ScratchFolder scratch;
  RunResult run = sample_run(
      {.samples = 6000, .load_recorded = false, .fitted = false, .verdict = GapVerdict::kInconclusive});
  run.notes.push_back("The recording was resampled to 400 Hz.");
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  EXPECT_TRUE(has(text, "inconclusive (the load was moving"));
  for (const char* name : {"fig3_backlash_map.png", "fig6_one_period.png", "residuals.png"}) {
    EXPECT_FALSE(fs::exists(scratch.path / name)) << name;
    EXPECT_TRUE(has(text, "- `" + std::string(name) + "`: ")) << name;
  }
  EXPECT_TRUE(has(text, "## Notes\n\n- The recording was resampled to 400 Hz."));
}

TEST(Report, OfARejectedModelShowsNoIntervalOfItAnywhere) {
  ScratchFolder scratch;
  RunResult run = sample_run({.samples = 6000, .load_recorded = false, .detected = false});
  run.comparison.reset();
  run.reference->trust = FitTrust::kRejected;
  run.reference->why = Remark::said("The model misses 65 % of what the torque does to the motion.");
  run.answer = answer_of({nullptr, &*run.reference, {}, run.coordinates});
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  EXPECT_TRUE(has(text, "# rig_p\n\n- **Gap:** The gap is not known.\n"));
  EXPECT_TRUE(has(text, "The fitted model is rejected. The model misses 65 %"));
  EXPECT_TRUE(has(text, "Trust: rejected. The model misses 65 %"));
  EXPECT_TRUE(has(text, "| `gap` | 18.8 mrad | yes |"));
  EXPECT_FALSE(has(text, " ± ")) << text;
  EXPECT_FALSE(has(text, "(95 %")) << text;
}

TEST(Report, DrawnAgainGivesTheSameBytesAndRemovesFiguresThatNoLongerAre) {
  ScratchFolder scratch;
  write_run_result(scratch.path.string(),
                   sample_run({.samples = 6000, .load_recorded = false, .fitted = false}));
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  const std::string image = text_of(scratch.path / "fig5_displacement_and_error.png");
  std::ofstream(scratch.path / "residuals.png") << "of an earlier result";
  std::ofstream(scratch.path / "photo.png") << "not ours";
  write_report(scratch.path.string());
  EXPECT_EQ(text, text_of(scratch.path / "report.md"));
  EXPECT_TRUE(image == text_of(scratch.path / "fig5_displacement_and_error.png"));
  EXPECT_FALSE(fs::exists(scratch.path / "residuals.png"));
  EXPECT_TRUE(fs::exists(scratch.path / "photo.png"));
}

TEST(Report, TellsWhichBoundDecided) {
  ScratchFolder scratch;
  write_run_result(scratch.path.string(),
                   sample_run({.samples = 6000, .load_recorded = false, .fitted = false}));
  write_report(scratch.path.string());
  const std::string text = text_of(scratch.path / "report.md");
  EXPECT_NE(text.find("Bounds: L = 4.1 rad/s² decides t2."), std::string::npos);
}

TEST(Report, SaysNothingOfAResamplingThatWasNotMade) {
  ScratchFolder scratch;
  const RunResult run = sample_run({.samples = 6000, .load_recorded = false, .fitted = false});
  ASSERT_TRUE(run.notes.empty());
  ASSERT_TRUE(run.recordings.front().resampling.empty());
  write_run_result(scratch.path.string(), run);
  write_report(scratch.path.string());
  EXPECT_FALSE(has(text_of(scratch.path / "report.md"), "`: \n"));
}

TEST(Report, OfAFolderWithoutAResultIsAnErrorOfTheInput) {
  ScratchFolder scratch;
  EXPECT_THROW(write_report(scratch.path.string()), ConfigError);
}

/// Beside a diagnosis that has found what the rejected model lacks, that model is no more than where it
/// began.
TEST(Report, TellsARejectedModelAsReplacedByThatOfTheDiagnosis) {
  RunResult run = sample_run({.samples = 6000});
  run.reference->trust = FitTrust::kRejected;
  run.reference->warnings = {Remark("told_here", "the model does not explain the recordings")};
  run.reference->advice = {Remark("advice", "sharpen it")};
  DiagnosisResult diagnosis;
  diagnosis.diagnosis.effects = {"cogging_torque", "input_delay"};
  ModelGap gap;
  gap.origin = GapOrigin::kEstimated, gap.value = 0.0213, gap.ci95 = {0.0212, 0.0214};
  diagnosis.diagnosis.model_gap = gap;
  diagnosis.answer.emplace().from = AnswerSource::kReference;
  EXPECT_EQ(warnings_of(run, &diagnosis), warnings_of(run)) << "the estimate's own answer stands";
  diagnosis.answer->from = AnswerSource::kDiagnosis;
  EXPECT_EQ(warnings_of(run).size(), warnings_of(run, &diagnosis).size() + 1);
  const std::string text = estimate_text(run, {}, &diagnosis);
  EXPECT_TRUE(
      has(text, "| model with all that was added (diagnosis) | 21.300 mrad | 21.200 to 21.400 mrad |"));
  EXPECT_TRUE(has(text, "without cogging torque and input delay, which the diagnosis has added"));
  EXPECT_TRUE(has(text, "- the model does not explain the recordings\n"));
  EXPECT_FALSE(has(text, "sharpen it"));
  EXPECT_TRUE(has(estimate_text(run, {}), "sharpen it"));
}

}  // namespace
}  // namespace gapscope
