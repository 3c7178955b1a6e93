// The configurations of the repository and the real recordings, through the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/executable.h"
#include "results/run_result.h"
#include "support/data.h"

namespace gapscope {
namespace {

using testing::data_folder;
using testing::Workplace;

RunResult run(const Workplace& place, const std::filesystem::path& config,
              const std::string& command = "run") {
  const auto outcome = place.run(command + " " + config.string() + " -o report");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "report/overview.png"));
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "report/report.md"));
  return read_run_result((place.folder() / "report").string());
}

RunResult run_config(const std::string& name) {
  const Workplace place;
  return run(place, std::filesystem::path(GAPSCOPE_SOURCE_DIR) / "configs" / name);
}

double share_off(double estimate, double truth) { return std::abs(estimate / truth - 1.0); }

bool holds(const Interval& interval, double value) { return interval.low <= value && value <= interval.high; }

/// Passages that begin at the given time, within what t1 is good for (10 ms), and end within half a second.
int passages_just_after(const GapEstimate& estimate, double time) {
  int count = 0;
  for (const GapEvent& e : estimate.events)
    count += e.accepted && std::abs(e.t1 - time) < 0.01 && e.t2 > time && e.t2 < time + 0.5 ? 1 : 0;
  return count;
}

TEST(Configurations, TheApplicationExampleReadsTheGapWhereThePaperSeesTheDistortions) {
  const RunResult r = run_config("01_application_example.yaml");
  ASSERT_EQ(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_LT(share_off(r.model_free->gap, 0.0188), 0.05);
  EXPECT_TRUE(holds(r.model_free->ci95, 0.0188));
  EXPECT_EQ(passages_just_after(*r.model_free, 5.0), 1);
  EXPECT_EQ(passages_just_after(*r.model_free, 10.0), 1);
  EXPECT_THAT(r.notes, ::testing::Contains(::testing::HasSubstr("would have missed")));
  EXPECT_LT(share_off(r.reference->find("gap")->value, 0.0188), 0.001);
}

TEST(Configurations, TheOtherReadingOfTheApplicationExampleIsNotMisread) {
  const RunResult r = run_config("01_application_example_g2_acceleration.yaml");
  if (r.model_free->verdict == GapVerdict::kBacklash) {
    EXPECT_LT(share_off(r.model_free->gap, 0.0188), 0.05);
  }
  EXPECT_LT(share_off(r.reference->find("gap")->value, 0.0188), 0.001);
}

TEST(Configurations, TheExperimentIsReadWithinThreePercentByBothAndTheIntervalsHoldTheTruth) {
  const RunResult r = run_config("02_experiment.yaml");
  ASSERT_EQ(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_LT(share_off(r.model_free->gap, 0.019), 0.03);
  EXPECT_TRUE(holds(r.model_free->ci95, 0.019));
  const FittedParameter* gap = r.reference->find("gap");
  EXPECT_TRUE(r.reference->converged());
  EXPECT_LT(share_off(gap->value, 0.019), 0.03);
  EXPECT_TRUE(holds(gap->ci95, 0.019));
  EXPECT_EQ(r.comparison->agree, true);
}

TEST(Configurations, ThePapersOwnRegimeIsReadAsPrintedWithNoIntervalAndTheFitHeadsTheAnswer) {
  const RunResult r = run_config("12_paper_experiment.yaml");
  ASSERT_EQ(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_EQ(r.model_free->method, GapMethod::kLiteral);
  EXPECT_LT(share_off(r.model_free->gap, 0.019), 0.05);
  EXPECT_GT(r.model_free->std, 0.0);
  EXPECT_TRUE(std::isnan(r.model_free->ci95.low));
  EXPECT_FALSE(r.comparison->agree) << "a scatter is no error of the mean";
  EXPECT_LT(share_off(r.reference->find("gap")->value, 0.019), 0.001);
  EXPECT_EQ(r.answer->from, AnswerSource::kReference);
}

TEST(Configurations, TheRecordingFromAnotherPlantIsReadByBoth) {
  constexpr double kTrueGap = 0.0218023708;  // of drive 1056
  const RunResult r = run_config("03_recording.yaml");
  ASSERT_EQ(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_LT(share_off(r.model_free->gap, kTrueGap), 0.03);
  EXPECT_TRUE(holds(r.model_free->ci95, kTrueGap));
  EXPECT_LT(share_off(r.reference->find("gap")->value, kTrueGap), 0.001);
  EXPECT_TRUE(holds(r.reference->find("gap")->ci95, kTrueGap));
}

TEST(RealRecordings, ABallScrewAxisOfOneInertiaHasNoBacklash) {
  GAPSCOPE_NEEDS_DATA();
  Workplace place;
  place.file("emps.yaml", "recording: {file: " + (data_folder() / "emps/emps_train.csv").string() +
                              "}\n"
                              "encoder: {quantum: 5.0e-8}\ncoordinates: translation\nmodel:\n  parameters:\n"
                              "    motor_inertia: {value: 80, estimate: true, bounds: [10, 1000]}\n"
                              "    torque_constant: 1\n    motor_damping: {value: 100, estimate: true}\n"
                              "    mass_ratio: 0\n");
  const RunResult r = run(place, "emps.yaml");
  EXPECT_NE(r.model_free->verdict, GapVerdict::kBacklash);
  if (r.model_free->verdict == GapVerdict::kNone) {
    EXPECT_GT(r.model_free->smallest_visible_gap, 0.0);
  }
  EXPECT_EQ(r.reference->find("gap"), nullptr);
}

TEST(Configurations, RampsAgainstALockedOutputAreReadAsPlayAtZeroTorqueAndTheReferenceTakesTheGapOutOfIt) {
  const RunResult r = run_config("06_locked_output.yaml");
  ASSERT_EQ(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_EQ(r.model_free->quantity, GapQuantity::kPlayAtZeroTorque);
  EXPECT_TRUE(holds(r.model_free->ci95, 0.01 + 2.0 * 0.02 / 300.0));
  EXPECT_TRUE(holds(r.reference->find("gap")->ci95, 0.01));
  EXPECT_FALSE(r.comparison->agree) << "a play is not compared with a gap";
}

/// What the detector says is judged: the fit of such a recording takes long.
RunResult detect_locked(const std::string& file) {
  Workplace place;
  place.file("locked.yaml", "recording: {file: " + (data_folder() / file).string() +
                                ", window: [0, 20.31], resample: {rate: 400}}\n"
                                "encoder: {bits: 16}\nmodel:\n  load: locked\n  parameters:\n"
                                "    motor_inertia: 0.05\n    torque_constant: 1\n"
                                "    motor_damping: {value: 1, estimate: true, bounds: [0, 100]}\n"
                                "    gap: {value: 0.02, estimate: true, bounds: [0, 0.2]}\n"
                                "    contact_stiffness: {value: 500, estimate: true, bounds: [10, 10000]}\n"
                                "    contact_damping: 1\n");
  return run(place, "locked.yaml", "detect");
}

TEST(RealRecordings, AReducerWithPlayAndALockedOutputIsReadAtZeroTorque) {
  GAPSCOPE_NEEDS_DATA();
  const RunResult r = detect_locked("cycloidal/baseline_pos1.csv");
  ASSERT_EQ(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_EQ(r.model_free->method, GapMethod::kLostMotion);
  EXPECT_LT(share_off(r.model_free->gap, 0.0335), 0.1);
  EXPECT_FALSE(r.recordings.front().resampling.empty());
}

TEST(RealRecordings, APreloadedReducerWithALockedOutputHasNoPlay) {
  GAPSCOPE_NEEDS_DATA();
  const RunResult r = detect_locked("cycloidal/splitpreload3_pos1.csv");
  EXPECT_NE(r.model_free->verdict, GapVerdict::kBacklash) << r.model_free->reason;
  EXPECT_EQ(r.model_free->lost_motion.cause, LostMotionCause::kFriction);
  EXPECT_LT(r.model_free->smallest_visible_gap, 0.006);
}

TEST(Configurations, ADriveWithDetentsIsSaidToLackThemAndNothingElse) {
  const Workplace place;
  const auto config = std::filesystem::path(GAPSCOPE_SOURCE_DIR) / "configs/08_missing_cogging.yaml";
  const auto outcome = place.run("diagnose " + config.string() + " -o report");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              ::testing::HasSubstr(
                  "\ncause       Established: cogging torque.\nhelps       Cogging torque brings the missing "
                  "torque down from 5.46 to 0.63"));
  EXPECT_THAT(outcome.out, ::testing::HasSubstr(
                               "effect      cogging_torque  at 24 cycles per turn of x1; amplitude 8.000"));
  EXPECT_THAT(outcome.out, ::testing::HasSubstr("eriodic in the motor angle with 24 cycles per turn"));
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "report/diagnosis.png"));
}

}  // namespace
}  // namespace gapscope
