// Rows that are no readings of their own, and inputs that changed between the rows: no number of them is
// trusted well.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "diagnosis/among.h"
#include "gapscope/recording/recording_file.h"
#include "results/scratch_folder.h"
#include "run/changed_rows.h"
#include "run/run_diagnosis.h"
#include "support/paper_model.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

const Progress kSilentRun = [](const std::string&) {};

/// The paper's rig, made by the plant that shares no code with the fit.
Recording rows_of_rig() {
  const std::string yaml =
      "encoder: {bits: 18}\nsimulation: {plant: independent, rate: 1000, duration: 4, excitation: {sine: {amplitude: "
      "0.58, frequency: 1}}}\nmodel: " +
      std::string(testing::kPaperModel);
  return recorded(simulated_recording(parse_configuration(yaml, "rig.yaml")));
}

/// A recording in a folder of its own, with a configuration that finds gap, damping and mass ratio in it.
struct Drive {
  explicit Drive(const Recording& rows) {
    write_csv((folder.path / "drive.csv").string(), rows);
    std::ofstream((folder.path / "drive.yaml").string())
        << "recording: {file: drive.csv}\nencoder: {bits: 18}\nmodel: " << testing::kPaperModel;
  }
  Configuration configuration() const { return load_configuration((folder.path / "drive.yaml").string()); }
  RunResult estimate() const { return run_pipeline(configuration(), {true, true}, kSilentRun).result; }

  ScratchFolder folder;
};

TEST(FilledRows, AreADoubtThatNoNumberOfThemIsTrustedWellWith) {
  const Recording rig = rows_of_rig();
  EXPECT_EQ(Drive(rig).estimate().answer->trust, AnswerTrust::kGood);
  for (const Recording& filled : {held(rig, 2), held(rig, 4), twice(rig, false), twice(rig, true)}) {
    const RunResult r = Drive(filled).estimate();
    ASSERT_FALSE(r.doubts.empty());
    EXPECT_EQ(r.doubts.front().code, "fresh_samples") << r.doubts.front().found;
    EXPECT_NE(r.reference->trust, FitTrust::kGood) << r.reference->full_report();
    EXPECT_NE(r.answer->trust, AnswerTrust::kGood) << r.answer->sentence;
    EXPECT_THAT(r.answer->next.front(), HasSubstr("resample: {rate: "));
  }
}

TEST(FilledRows, TakenAtTheRateTheyWereReadAtAreNoDoubt) {
  const Drive drive(held(rows_of_rig(), 2));
  Configuration c = drive.configuration();
  c.recording->reading.resample_rate = 500.0;
  EXPECT_TRUE(run_pipeline(c, {true, false}, kSilentRun).result.doubts.empty());
}

/// With one candidate: what is asked here is not what is missing.
DiagnosisOptions one_candidate() { return test::among({"motor_coulomb_friction"}); }

TEST(FilledRows, AreADoubtToADiagnosisToo) {
  const Drive drive(held(rows_of_rig(), 2));
  const DiagnosisOutcome held_twice = run_diagnosis(drive.configuration(), one_candidate());
  ASSERT_FALSE(held_twice.result.diagnosis.doubts.empty());
  EXPECT_EQ(held_twice.result.diagnosis.doubts.front().code, "fresh_samples");
  const auto told = answer_of_diagnosis(held_twice.result.diagnosis, held_twice.result.coordinates);
  EXPECT_TRUE(!told || told->trust != AnswerTrust::kGood);
}

TEST(InputTiming, OfEverySecondRowLeavesADiagnosisNoGoodNumberThatMisses) {
  const Drive drive(every_second(rows_of_rig()));
  const DiagnosisOutcome out = run_diagnosis(drive.configuration(), one_candidate());
  const Diagnosis& d = out.result.diagnosis;
  const auto told = answer_of_diagnosis(d, out.result.coordinates);
  ASSERT_TRUE(told) << d.sentence;
  if (told->trust != AnswerTrust::kGood) return;
  EXPECT_LE(told->ci95.low, 0.019) << told->sentence;
  EXPECT_GE(told->ci95.high, 0.019) << told->sentence;
}

}  // namespace
}  // namespace gapscope
