#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/run/run_diagnosis.h"
#include "results/scratch_folder.h"
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

/// A recording of the paper's rig, and a configuration that names it twice.
class Recorded {
 public:
  Recorded() {
    const Configuration simulated = parse_configuration(kSimulated, "simulated.yaml");
    write_csv(at("drive.csv"), simulated_recording(simulated));
    std::filesystem::copy_file(at("drive.csv"), at("again.csv"));
    std::ofstream(at("drive.yaml")) << "recording: {file: drive.csv, held_out: again.csv}\nmodel: "
                                    << testing::kPaperModel;
  }
  std::string at(const char* name) const { return (folder_.path / name).string(); }
  Configuration configuration() const { return load_configuration(at("drive.yaml")); }

 private:
  ScratchFolder folder_;
};

TEST(RunPipeline, AsksOnlyTheEstimatorsThatAreWanted) {
  const Configuration c = parse_configuration(kSimulated, "simulated.yaml");
  const RunResult result = run_pipeline(c, {true, false}, kSilent).result;
  EXPECT_TRUE(result.model_free);
  EXPECT_FALSE(result.reference || result.comparison);
  EXPECT_EQ(result.simulated_gap, c.simulation->plant.drive.gap);
}

TEST(LoadRecordings, NamesSourcesByTheirContent) {
  const Recorded recorded;
  const std::vector<FileHash> before = sources_of(recorded.configuration());
  ASSERT_EQ(before.size(), 3u);
  EXPECT_EQ(before[1].sha256, before[2].sha256) << "the same recording under two names";
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
  EXPECT_EQ(all.train.recordings[0].x1, all.held_out.recordings[0].x1);
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

}  // namespace
}  // namespace gapscope
