#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "results/scratch_folder.h"
#include "run/run_diagnosis.h"
#include "support/paper_model.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Progress kSilent = [](const std::string&) {};

const std::string kSimulated = R"(encoder: {bits: 18}
simulation: {rate: 1000, duration: 2, excitation: {sine: {amplitude: 0.58, frequency: 1}}, noise: 1.0e-5}
model: )" + std::string(testing::kPaperModel);

/// The paper's rig recorded twice, in the same motion, and a configuration with both.
class Recorded {
 public:
  Recorded() {
    Configuration simulated = parse_configuration(kSimulated, "simulated.yaml");
    write_csv(at("drive.csv"), simulated_recording(simulated));
    simulated.simulation->seed = 2;
    write_csv(at("again.csv"), simulated_recording(simulated));
    std::ofstream(at("drive.yaml")) << "recording: {file: drive.csv, held_out: again.csv}\nmodel: "
                                    << testing::kPaperModel;
  }
  std::string at(const char* name) const { return (folder_.path / name).string(); }
  Configuration configuration() const { return load_configuration(at("drive.yaml")); }

 private:
  ScratchFolder folder_;
};

TEST(RunPipeline, SaysTheSameWhetherItsEstimatorsWorkInTurnOrSideBySide) {
  const Configuration c = parse_configuration(kSimulated, "simulated.yaml");
  const StoredResult in_turn = stored_run_result(run_pipeline(c, {true, true}, kSilent, 1).result);
  const StoredResult beside = stored_run_result(run_pipeline(c, {true, true}, kSilent, 2).result);
  EXPECT_EQ(in_turn.json, beside.json);
  ASSERT_EQ(in_turn.traces.size(), beside.traces.size());
  for (std::size_t i = 0; i < in_turn.traces[0].columns.size(); ++i)
    EXPECT_EQ(in_turn.traces[0].columns[i].numbers, beside.traces[0].columns[i].numbers);
}

TEST(RunPipeline, AsksOnlyTheEstimatorsThatAreWanted) {
  const Configuration c = parse_configuration(kSimulated, "simulated.yaml");
  const RunResult result = run_pipeline(c, {true, false}, kSilent).result;
  EXPECT_TRUE(result.model_free);
  EXPECT_FALSE(result.reference || result.comparison);
  EXPECT_EQ(result.simulated_gap, c.simulation->plant.drive.gap);
}

TEST(RunPipeline, NotesOnceWhatThePublishedBoundIsAndWhatItIsFrom) {
  const auto run = [](const std::string& detector) {
    return run_pipeline(parse_configuration(kSimulated + detector, "simulated.yaml"), {true, false}, kSilent)
        .result;
  };
  const auto of_13 = HasSubstr("eq. (13)");
  const RunResult bank = run(""), given = run("\ndetector: {bound: 40}\n");
  const RunResult taken =
      run("\ndetector: {bound: {from_model: {input_limit: 0.58, load_force_bound: 0.05}}}\n");
  EXPECT_THAT(bank.notes,
              ::testing::Contains(::testing::AllOf(of_13, HasSubstr("the configuration's numbers"),
                                                   HasSubstr("does not use it"))));
  EXPECT_TRUE(bank.model_free->warnings.empty()) << "another choice of L is no doubt about this one";
  EXPECT_THAT(given.notes, ::testing::Each(::testing::Not(of_13)));
  ASSERT_THAT(taken.notes, ::testing::Contains(of_13).Times(1));
  EXPECT_THAT(taken.notes, ::testing::Contains(::testing::AllOf(HasSubstr("|u| <= 0.58, G = 0.05 N·m"),
                                                                HasSubstr("is taken"))));
}

TEST(RunPipeline, KnowsDataThatNoDriveMade) {
  const Configuration simulated = parse_configuration(kSimulated, "simulated.yaml");
  EXPECT_THAT(run_pipeline(simulated, {true, true}, kSilent).result.simulated_data,
              ElementsAre(HasSubstr("the very equations that are fitted here")));
  EXPECT_THAT(run_pipeline(simulated, {true, false}, kSilent).result.simulated_data,
              ElementsAre("The data are simulated; no drive was measured."))
      << "nothing is fitted";
  const Recorded recorded;
  EXPECT_THAT(run_pipeline(recorded.configuration(), {true, false}, kSilent).result.simulated_data,
              ElementsAre("drive.csv, again.csv were made by `gapscope simulate`; no drive was measured."));
}

TEST(LoadRecordings, OfOneInertiaAreTheSameByBothPlants) {
  const auto recorded = [](const std::string& plant) {
    const std::string yaml = "encoder: {bits: 20}\nsimulation: {rate: 1000, duration: 1, plant: " + plant +
                             ", excitation: {sine: {amplitude: 0.5, frequency: 1}}}\n"
                             "model: {parameters: {motor_inertia: 8.78e-4, torque_constant: 0.172, "
                             "motor_damping: 0.062, mass_ratio: 0}}\n";
    return simulated_recording(parse_configuration(yaml, "one.yaml"));
  };
  const Recording one = recorded("simulator"), other = recorded("independent");
  ASSERT_EQ(one.size(), other.size());
  EXPECT_TRUE(other.x2.empty());
  const double count = 2.0 * kPi / (1 << 20);  // both count; where the motion is between two, they may differ
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one.x1[i], other.x1[i], 1.01 * count) << i;
}

TEST(LoadRecordings, NamesSourcesByTheirContent) {
  const Recorded recorded;
  const std::vector<FileHash> before = sources_of(recorded.configuration());
  ASSERT_EQ(before.size(), 3u);
  EXPECT_NE(before[1].sha256, before[2].sha256);
  EXPECT_THAT(source_paths(recorded.configuration()),
              ElementsAre(recorded.at("drive.yaml"), recorded.at("drive.csv"), recorded.at("again.csv")));
  std::ofstream(recorded.at("again.csv"), std::ios::app) << "# a note\n";
  EXPECT_NE(sources_of(recorded.configuration())[2].sha256, before[2].sha256);
}

TEST(LoadRecordings, ForADiagnosisAreReadAsTheyAreForAnEstimate) {
  const Recorded recorded;
  const DiagnosisRecordings all = load_for_diagnosis(recorded.configuration(), kSilent);
  ASSERT_EQ(all.train.recordings.size(), 1u);
  ASSERT_EQ(all.held_out.motor_traces().size(), 1u);
  EXPECT_EQ(all.held_out.recordings[0].x1, read_recording(recorded.at("again.csv"), {}).x1);
  EXPECT_EQ(all.held_out.recordings[0].file, "again.csv");
  std::filesystem::remove(recorded.at("again.csv"));
  EXPECT_THAT(testing::refusal([&] { load_for_diagnosis(recorded.configuration(), kSilent); }),
              HasSubstr("drive.yaml:1: there is no recording again.csv"));
}

/// Nothing but the nominal model, which is fitted for any diagnosis.
DiagnosisOptions without_candidates(const Configuration& c) {
  DiagnosisOptions options = diagnosis_options(c);
  for (const EffectEntry* e : effect_table()) options.excluded.emplace_back(e->name);
  return options;
}

/// A recording whose x1 is read anew in every fifth row only.
void hold_positions(const std::string& path) {
  Recording r = read_recording(path, {});
  for (std::size_t i = 0; i < r.size(); ++i) r.x1[i] = r.x1[i - i % 5];
  write_csv(path, r);
}

TEST(RunDiagnosis, TellsOfWhatItWasMade) {
  const Recorded recorded;
  const Configuration c = recorded.configuration();
  const DiagnosisOutcome out = run_diagnosis(c, without_candidates(c));
  EXPECT_EQ(out.result.name, "drive");
  EXPECT_EQ(out.result.configuration, resolved_yaml(c));
  EXPECT_EQ(out.result.sources, sources_of(c));
  EXPECT_EQ(out.first.file, "drive.csv");
  EXPECT_EQ(out.result.diagnosis.verdict, DiagnosisVerdict::kNone) << out.result.diagnosis.sentence;
  EXPECT_TRUE(out.result.diagnosis.next_experiment.sentence.empty());
}

TEST(RunDiagnosis, SaysFirstWhatSpoilsARecordingBeItHeldOut) {
  const Recorded recorded;
  hold_positions(recorded.at("again.csv"));
  const Configuration c = recorded.configuration();
  const std::vector<std::string> warnings = run_diagnosis(c, without_candidates(c)).result.diagnosis.warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings.front(), HasSubstr("again.csv: fresh samples: x1 changes in every 5th row only"));
}

/// The drive of drive.yaml under an input of the same form.
void record_at(const Recorded& recorded, const char* name, const std::string& amplitude) {
  std::string text = kSimulated;
  text.replace(text.find("0.58"), 4, amplitude);
  write_csv(recorded.at(name), simulated_recording(parse_configuration(text, "simulated.yaml")));
}

/// What a diagnosis tells before it begins.
std::vector<std::string> told_before(const Configuration& c) {
  std::vector<std::string> told;
  const DiagnosisOutcome out =
      run_diagnosis(c, without_candidates(c), [&](const std::string& warning) { told.push_back(warning); });
  for (const std::string& warning : told)
    EXPECT_THAT(out.result.diagnosis.warnings, ::testing::Contains(warning))
        << "it stands in the report, too";
  return told;
}

TEST(RunDiagnosis, SaysBeforehandThatTheOtherWayRoundAsksMoreOfTheDrive) {
  const Recorded recorded;
  EXPECT_THAT(told_before(recorded.configuration()), ElementsAre()) << "both are alike";
  record_at(recorded, "again.csv", "0.29");
  EXPECT_THAT(told_before(recorded.configuration()), ElementsAre()) << "what is fitted covers the other";
  record_at(recorded, "again.csv", "1.16");
  const std::vector<std::string> told = told_before(recorded.configuration());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told.front(), HasSubstr("again.csv, held out, asks more of the drive than drive.csv"));
  EXPECT_THAT(told.front(), HasSubstr("input up to 1.16 against 0.58 units of u"));
  EXPECT_THAT(told.front(), HasSubstr("(file: again.csv, held_out: drive.csv) is worth a diagnosis"));
}

TEST(RunDiagnosis, RefusesARecordingThatChangesWhileItIsRead) {
  const Recorded recorded;
  const Configuration c = recorded.configuration();
  DiagnosisOptions options = without_candidates(c);
  options.progress = [&](const std::string&) {
    std::ofstream(recorded.at("again.csv"), std::ios::app) << "# a note\n";
  };
  EXPECT_THAT(testing::refusal([&] { run_diagnosis(c, options); }),
              HasSubstr("drive.yaml: names a file that changed while it was read, expected it to stay"));
}

/// The recording of before with steps of their own length.
class RecordedUnevenly : public Recorded {
 public:
  explicit RecordedUnevenly(const std::string& resample) {
    Recording r = read_recording(at("drive.csv"));
    auto draw = random_stream(1, "stamps");
    std::vector<double> stamps;
    for (std::size_t i = 0; i < r.size(); ++i) stamps.push_back(r.time(i) + 1e-4 * uniform(draw, 0.0, 1.0));
    r.stamps = stamps;
    write_csv(at("uneven.csv"), r);
    std::ofstream(at("drive.yaml")) << "recording: {file: uneven.csv" << resample
                                    << "}\nmodel: " << testing::kPaperModel;
  }
};

TEST(UnevenRecordings, AreFittedAndDiagnosedAsTheyAre) {
  const RecordedUnevenly recorded("");
  const RunResult r = run_pipeline(recorded.configuration(), {false, true}, kSilent).result;
  ASSERT_FALSE(r.recordings.front().even());
  EXPECT_EQ(r.reference->traces.front().x1.size(), r.recordings.front().size());
  EXPECT_THAT(r.notes, ::testing::Contains(HasSubstr("each taken with its own length")));
  EXPECT_FALSE(load_for_diagnosis(recorded.configuration(), kSilent).train.recordings.front().even());
}

TEST(UnevenRecordings, AreRefusedWhereTheDetectorIsAskedFor) {
  const RecordedUnevenly recorded("");
  for (const bool reference : {false, true})
    EXPECT_THAT(testing::refusal([&] {
                  run_pipeline(recorded.configuration(), {true, reference}, kSilent);
                }),
                HasSubstr("time is not uniform"));
}

TEST(UnevenRecordings, AreResampledForTheDetectorAlone) {
  const RecordedUnevenly recorded(", resample: {rate: 1000, for: detector}");
  const RunResult r = run_pipeline(recorded.configuration(), {true, true}, kSilent).result;
  const Recording& shown = r.recordings.front();
  EXPECT_FALSE(shown.even());
  EXPECT_TRUE(shown.resampling.empty());
  ASSERT_TRUE(r.model_free && r.reference);
  for (const ErrorTrace& trace : r.model_free->traces) EXPECT_EQ(trace.error.size(), shown.size());
  EXPECT_EQ(r.reference->traces.front().x1.size(), shown.size());
  EXPECT_THAT(r.notes, ::testing::Contains(HasSubstr("for the detector alone resampled")));
  EXPECT_TRUE(
      run_pipeline(recorded.configuration(), {true, false}, kSilent).result.recordings.front().even());
}

/// The rig in rows of a millisecond, with another inertia of its motor.
std::string with_inertia(const std::string& inertia) {
  return "encoder: {bits: 18}\nsimulation: {rate: 1000, duration: 0.1, excitation: {sine: {amplitude: 0.58, "
         "frequency: 1}}}\nmodel: " +
         replaced(testing::kPaperModel, "8.78e-4", inertia);
}

TEST(SimulatedRecording, OfADriveThatMovesOutOfAllProportionToItsRowsIsRefused) {
  EXPECT_EQ(simulated_recording(parse_configuration(with_inertia("1.0e-6"), "c.yaml")).size(), 100U);
  const Configuration tiny = parse_configuration(with_inertia("1.0e-12"), "c.yaml");
  EXPECT_THAT(testing::refusal([&] { simulated_recording(tiny); }),
              ::testing::AllOf(HasSubstr("c.yaml:2: simulates a drive whose fastest motion"),
                               HasSubstr("expected at most 1500: a larger motor_inertia")));
}

}  // namespace
}  // namespace gapscope
