// The encoder on the load, and one on either body: from the configuration to the stored result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "gapscope/recording/recording_file.h"
#include "results/run_result.h"
#include "results/scratch_folder.h"
#include "run/run_pipeline.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

const Progress kQuiet = [](const std::string&) {};

std::string simulated_with(const char* encoder) {
  return std::string("encoder: ") + encoder +
         "\nsimulation: {rate: 1000, duration: 2, excitation: {sine: {amplitude: 0.58, frequency: 1}}, noise: "
         "1.0e-5}\nmodel: " +
         testing::kPaperModel;
}

Configuration simulated(const char* encoder) {
  return parse_configuration(simulated_with(encoder), "simulated.yaml");
}

TEST(EncoderOnLoad, IsWrittenThroughItsCountsAndReadBackAsTheLoads) {
  const Recording r = simulated_recording(simulated("{bits: 14, side: load}"));
  const double quantum = 2.0 * kPi / 16384.0;
  ScratchFolder folder;
  const std::string path = (folder.path / "drive.csv").string();
  write_csv(path, r);
  ReadOptions options;
  options.columns = options.columns.read_from_load();
  options.encoder = EncoderSide::kLoad;
  const Recording again = read_recording(path, options);
  EXPECT_EQ(again.x1, r.x1);
  EXPECT_EQ(again.x2, r.x2);
  EXPECT_EQ(again.position(), r.x2);
  EXPECT_NEAR(again.quantum, quantum, 1e-12);
  for (const double x : r.x2) EXPECT_NEAR(std::remainder(x, quantum), 0.0, 1e-12);
}

TEST(EncoderOnLoad, GivesTheReferenceAGapAndTheDetectorAReasonWhyNot) {
  const RunResult r = run_pipeline(simulated("{bits: 18, side: load}"), {true, true}, kQuiet).result;
  ASSERT_TRUE(r.model_free && r.reference);
  EXPECT_EQ(r.model_free->verdict, GapVerdict::kInconclusive);
  EXPECT_EQ(r.model_free->reason.code(), "encoder_on_load");
  EXPECT_THAT(r.model_free->reason.text(), HasSubstr("the encoder is on the load"));
  const FittedParameter* gap = r.reference->find("gap");
  ASSERT_NE(gap, nullptr);
  EXPECT_LE(gap->ci95.low, r.simulated_gap);
  EXPECT_GE(gap->ci95.high, r.simulated_gap);
  EXPECT_EQ(r.answer->from, AnswerSource::kReference);
  EXPECT_FALSE(r.second_encoder);
}

TEST(EncoderOnLoad, ComesBackFromAStoredResultWithoutTheMotor) {
  RunResult r = run_pipeline(simulated("{bits: 18, side: load}"), {false, true}, kQuiet).result;
  r.recordings.front().x1.clear();
  ScratchFolder folder;
  write_run_result(folder.path.string(), r);
  const RunResult again = read_run_result(folder.path.string());
  EXPECT_EQ(again.recordings.front().encoder, EncoderSide::kLoad);
  EXPECT_TRUE(again.recordings.front().x1.empty());
  EXPECT_EQ(again.recordings.front().x2, r.recordings.front().x2);
  EXPECT_EQ(again.reference->traces.front().predicted, r.reference->traces.front().predicted);
  EXPECT_EQ(again.reference->traces.front().position(), r.reference->traces.front().x2);
}

TEST(EncoderOnLoad, OfOneBodyIsThatOfTheBody) {
  Configuration c = simulated("{bits: 18, side: load}");
  const Recording r = simulated_recording(c);
  ScratchFolder folder;
  write_csv((folder.path / "drive.csv").string(), r);
  std::ofstream(folder.path / "drive.yaml") << "recording: {file: drive.csv}\nencoder: {bits: 18, side: "
                                               "load}\nfit: {starts: 1}\nmodel: {parameters: "
                                               "{motor_inertia: 1.756e-3, torque_constant: 0.172, "
                                               "mass_ratio: 0, motor_damping: {value: 0.1, estimate: true}}}";
  const RunResult run =
      run_pipeline(load_configuration((folder.path / "drive.yaml").string()), {true, true}, kQuiet).result;
  EXPECT_EQ(run.model_free->reason.code(), "encoder_on_load") << "a model of one body denies no gap";
  write_run_result(folder.path.string(), run);
  const RunResult again = read_run_result(folder.path.string());
  EXPECT_EQ(again.recordings.front().position(), r.x2);
  EXPECT_EQ(again.reference->traces.front().position().size(), r.size());
  EXPECT_EQ(again.reference->traces.front().position(), run.reference->traces.front().x1);
}

TEST(EncodersOnBoth, OneEstimatesAndTheOtherValidates) {
  const RunResult r = run_pipeline(simulated("{bits: 16, side: both}"), {true, true}, kQuiet).result;
  ASSERT_TRUE(r.second_encoder);
  const SecondEncoder& s = *r.second_encoder;
  const double quantum = 2.0 * kPi / 65536.0;
  for (const double x : r.recordings.front().x2) EXPECT_NEAR(std::remainder(x, quantum), 0.0, 1e-12);
  EXPECT_LT(s.rmse,
            2.0 * s.floor);  // the model is the drive: the load's encoder leaves no more than the motor's
  EXPECT_GT(s.rmse, 0.5 * s.floor);
  EXPECT_GT(s.fit_percent, 99.0);
  EXPECT_NEAR(s.gap, r.simulated_gap, 0.1 * r.simulated_gap);
  EXPECT_NEAR(s.difference, r.reference->find("gap")->value - s.gap, 1e-12);
}

TEST(EncodersOnBoth, AModelThatIsWrongBehindTheGapIsSeen) {
  Configuration c = simulated("{bits: 16, side: both}");
  c.simulation->plant.drive.load_coulomb_friction *= 3.0;
  c.fit.starts = 1, c.fit.compare_parts = false;
  const RunResult r = run_pipeline(c, {false, true}, kQuiet).result;
  ASSERT_TRUE(r.second_encoder);
  EXPECT_GT(r.second_encoder->rmse, 5.0 * r.second_encoder->floor);
}

}  // namespace
}  // namespace gapscope
