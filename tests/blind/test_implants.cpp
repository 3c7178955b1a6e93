// Effects implanted into one's own recordings, here those of a drive of the independent plant.
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "blind/blind_check.h"
#include "blind/scored_answer.h"
#include "diagnosis/among.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "independent_plant/simulate.h"
#include "results/blind_files.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
namespace plant = independent_plant;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::refusal;
using testing::text_of;

/// A drive of one body that lacks a little friction, recorded twice, with a configuration of it.
class OwnDrive {
 public:
  explicit OwnDrive(const std::string& more = "", const char* inertias = "mass_ratio: 0") : place_("") {
    plant::BlindDrive drive;
    drive.load = plant::BlindLoad::kNone, drive.gap = 0.0;
    drive.motor_inertia = 1.75e-3, drive.motor_damping = 0.02;
    drive.effects.motor.friction.level_nm = 4e-3;
    for (const std::uint64_t seed : {1u, 2u}) {
      plant::BlindExcitation e;
      e.waveform = plant::Waveform::kMultisine, e.amplitude = 0.6, e.frequency = 0.5, e.frequency_end = 4.0;
      const auto u = plant::command(e, 500.0, 4.0, seed);
      write_csv((place_.folder() / (seed == 1 ? "first.csv" : "second.csv")).string(),
                simulate_blind_command(drive, u, plant::BlindSensor::with_bits(16), {500.0, 0.0, seed, 1e-9})
                    .recording);
    }
    std::ofstream(place_.folder() / "drive.yaml")
        << "recording: {file: first.csv, held_out: second.csv}\nencoder: {bits: 16}\nmodel:\n  parameters:\n"
           "    torque_constant: 0.172\n    motor_inertia: {value: 0.002, estimate: true}\n"
           "    motor_damping: {value: 0.02, estimate: true}\n    "
        << inertias << "\n"
        << more;
  }
  Configuration configuration() const {
    return load_configuration((place_.folder() / "drive.yaml").string());
  }
  fs::path folder() const { return place_.folder(); }

  BlindLabels make(const std::string& name, int threads = 2) const {
    const std::string labels = (folder() / (name + ".json")).string();
    make_implanted_check(configuration(), (folder() / name).string(), labels, threads);
    return read_blind_labels(labels);
  }

 private:
  testing::TemporaryFile place_;
};

constexpr const char* kFive =
    "implant: {first_seed: 5, known: 3, outside: 1, none: 1, sizes: [0.1], "
    "effects: [input_dead_zone, cogging_torque, encoder_eccentricity]}\n";

constexpr const char* kThree =
    "implant: {first_seed: 5, known: 1, outside: 1, none: 1, sizes: [0.1], effects: [input_dead_zone]}\n";

TEST(ImplantedCheck, HandsOutRecordingsWithWhatTheLabelsSayAndNoWordOfIt) {
  const OwnDrive drive(kFive);
  const BlindLabels labels = drive.make("cases");
  ASSERT_EQ(labels.cases.size(), 5u);
  const Recording original = read_recording((drive.folder() / "first.csv").string());
  for (const BlindLabel& l : labels.cases) {
    ASSERT_TRUE(l.implant) << l.name;
    const fs::path at = drive.folder() / "cases";
    const Recording r = read_recording((at / (l.name + "_train.csv")).string());
    ASSERT_EQ(r.size(), original.size());
    EXPECT_TRUE(fs::exists(at / (l.name + "_held_out.csv")));
    const std::string sheet = text_of((at / (l.name + ".yaml")).string());
    EXPECT_THAT(sheet, AllOf(Not(HasSubstr("implant")), Not(HasSubstr("dead_zone")), HasSubstr(l.name)));
    const std::string effect = l.effects.empty() ? "" : l.effects.front();
    EXPECT_EQ(r.x1 == original.x1, effect != "encoder_eccentricity" && effect != "lost_counts") << effect;
    EXPECT_EQ(r.u == original.u,
              effect.empty() || effect == "encoder_eccentricity" || effect == "lost_counts")
        << effect;
    EXPECT_EQ(l.implant->values.empty(), effect.empty());
    if (effect == "input_dead_zone") {
      const double width = l.implant->values.front().value;
      for (std::size_t i = 0; i < r.size(); ++i)
        EXPECT_NEAR(r.u[i] - original.u[i],
                    original.u[i] > 0.0   ? width
                    : original.u[i] < 0.0 ? -width
                                          : 0.0,
                    1e-12);
    }
    if (!effect.empty() && effect != "lost_counts") {
      EXPECT_NEAR(l.implant->size, 0.1, 1e-9);
      EXPECT_GT(l.implant->foretold_share, 0.5) << effect;  // hardly anything else is missing here
    }
  }
}

TEST(ImplantedCheck, IsTheSameOnAnyNumberOfThreadsAndWhenItIsMadeAgain) {
  const OwnDrive drive(kThree);
  const std::string manifest = (drive.folder() / "made/manifest.json").string();
  const BlindLabels one = drive.make("made", 1);
  const std::string first = text_of(manifest);
  const BlindLabels again = drive.make("made", 2);
  for (std::size_t i = 0; i < one.cases.size(); ++i)
    EXPECT_EQ(line_of(one.cases[i]), line_of(again.cases[i]));
  EXPECT_EQ(text_of(manifest), first);
}

TEST(ImplantedCheck, AnswersScoresAndGoesOnWhereItStopped) {
  const auto excluded =
      test::among({"motor_coulomb_friction", "input_dead_zone", "cogging_torque", "encoder_eccentricity"})
          .excluded;
  const OwnDrive drive(kFive + fmt::format("diagnosis: {{exclude: [{}]}}\n", fmt::join(excluded, ", ")));
  const std::string folder = (drive.folder() / "check").string();
  fs::create_directory(folder);
  drive.make("check/cases");  // as a kill between the steps leaves it
  fs::rename(folder + "/cases.json", folder + "/labels.json");
  const std::string labels = text_of(folder + "/labels.json");
  const BlindScore score = run_implanted_check(drive.configuration(), folder, 2);
  EXPECT_EQ(text_of(folder + "/labels.json"), labels);
  EXPECT_EQ(score.report_cases, 5);
  ASSERT_TRUE(score.of_implants());
  for (const BlindCount& c : score.counts) {
    if (c.name.starts_with("implant with a foretold share")) {
      EXPECT_GE(c.count, 2) << c.of;
    }
    if (c.name.starts_with("no implant")) {
      EXPECT_EQ(c.count, 1);
    }
  }
  const auto answered = fs::last_write_time(folder + "/answers.json");
  run_implanted_check(drive.configuration(), folder, 1);  // has nothing to do but to score
  EXPECT_EQ(fs::last_write_time(folder + "/answers.json"), answered);
  write_blind_score(folder, score);
  EXPECT_EQ(read_blind_score(folder).cases.front().implant->size, score.cases.front().implant->size);
}

TEST(ImplantedCheck, RefusesAChangedLabelAsAnyOther) {
  const OwnDrive drive(kFive);
  BlindLabels labels = drive.make("cases");
  const BlindManifest manifest = read_blind_manifest((drive.folder() / "cases/manifest.json").string());
  verify_labels(manifest, labels, "labels.json");
  labels.cases.front().implant->foretold_share = 0.01;
  EXPECT_THAT(refusal([&] { verify_labels(manifest, labels, "labels.json"); }), HasSubstr("another label"));
  labels.cases.front().implant.reset();
  EXPECT_THAT(refusal([&] { verify_labels(manifest, labels, "labels.json"); }), HasSubstr("another label"));
}

TEST(ImplantedCheck, RefusesByNameWhatNoRecordingCanBeGiven) {
  const auto refused = [](const OwnDrive& drive) { return refusal([&] { drive.make("cases"); }); };
  EXPECT_THAT(refused(OwnDrive("implant: {effects: [backlash]}\n")),
              AllOf(HasSubstr("drive.yaml:9"), HasSubstr("backlash"), HasSubstr("no encoder has recorded")));
  EXPECT_THAT(refusal([] { OwnDrive("implant: {sizes: [-0.1]}\n").configuration(); }),
              HasSubstr("drive.yaml:9"));
  EXPECT_THAT(refusal([] { OwnDrive("implant: {known: 0, outside: 0, none: 0}\n").configuration(); }),
              HasSubstr("no case"));
  EXPECT_THAT(refusal([] { OwnDrive("implant: {size: [0.1]}\n").configuration(); }), HasSubstr("size"));
  EXPECT_THAT(refusal([] {
                const OwnDrive drive(kFive);
                make_implanted_check(drive.configuration(), (drive.folder() / "cases").string(),
                                     (drive.folder() / "cases/labels.json").string(), 1);
              }),
              HasSubstr("a place apart"));
}

TEST(ImplantScore, CountsByForetoldShareAndForgivesWhatTheDriveHasAnyway) {
  BlindLabels labels;
  BlindAnswers answers;
  const auto add = [&](const char* effect, double share, const char* verdict, std::vector<std::string> added,
                       std::vector<std::string> alike = {}) {
    BlindLabel l;
    l.name = "case_" + std::to_string(labels.cases.size()), l.part = "report";
    if (*effect != '\0') l.effects = {effect};
    l.implant =
        ImplantLabel{0.1, share, {{"x", "", 1.0}}, {"motor_coulomb_friction"}, {"motor_coulomb_friction"}};
    labels.cases.push_back(l);
    BlindAnswer a;
    a.name = l.name, a.verdict = verdict, a.effects = added, a.alike = std::move(alike);
    if (std::string(verdict) == "effect") a.established = std::move(added);
    answers.cases.push_back(a);
  };
  add("input_delay", 0.8, "effect", {"motor_coulomb_friction", "input_delay"});
  add("cogging_torque", 0.4, "helps", {"torque_ripple"}, {"cogging_torque"});
  add("quadratic_drag", 0.35, "effect", {"motor_coulomb_friction"});
  add("torque_saturation", 0.2, "effect", {"quadratic_drag"});
  add("stribeck_friction", 0.02, "effect", {"motor_coulomb_friction"});
  add("knocks", 0.9, "effect", {"input_dead_zone"});
  add("stray_sine", 0.9, "helps", {"input_dead_zone"});
  add("", kNaN, "effect", {"motor_coulomb_friction"});
  const BlindScore score = score_blind_answers(labels, answers);
  std::map<std::string, std::pair<int, int>> counts;
  for (const BlindCount& c : score.counts) counts[c.name.substr(0, 12)] = {c.count, c.of};
  EXPECT_EQ(counts["implant with"], std::pair(2, 3));
  EXPECT_EQ(counts["foretold sha"], std::pair(0, 1));  // of both rows that begin so the last
  EXPECT_EQ(counts["all cases: a"], std::pair(2, 8));  // drag for saturation, a dead zone for knocks
  EXPECT_EQ(counts["outside the "], std::pair(1, 2));
  EXPECT_EQ(counts["no implant: "], std::pair(1, 1));
}

}  // namespace
}  // namespace gapscope
