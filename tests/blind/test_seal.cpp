#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "blind/blind_check.h"
#include "blind/case_plan.h"
#include "config/configuration.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "results/blind_files.h"
#include "results/sha256.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using testing::refusal;
using testing::text_of;

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

BlindConfig small(int known, int outside, int none, int pairs) {
  BlindConfig c;
  c.name = "small";
  c.calibration = {100, 1, 0, 0, 0};
  c.report = {200, known, outside, none, pairs};
  c.rigs = {"paper", "geared"};
  return c;
}

/// A check of five cases, made once and copied for each test that damages it.
class SealedCheck {
 public:
  SealedCheck() : place_("") { fs::copy(made(), place_.folder(), fs::copy_options::recursive); }
  std::string folder() const { return (place_.folder() / "cases").string(); }
  std::string labels() const { return (place_.folder() / "labels.json").string(); }
  BlindManifest manifest() const { return read_blind_manifest(folder() + "/manifest.json"); }

 private:
  static fs::path made() {
    static const testing::TemporaryFile place("");
    static const bool once = [] {
      fs::remove(place.path());
      make_blind_check(small(1, 1, 1, 1), (place.folder() / "cases").string(),
                       (place.folder() / "labels.json").string(), 2);
      return true;
    }();
    return once ? place.folder() : fs::path();
  }
  testing::TemporaryFile place_;
};

TEST(Sha256, IsThatOfItsStandard) {  // FIPS 180-2, appendix B.1, and the empty text
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(CasePlan, GivesEveryKindItsCasesAndEachASeedAndASaltOfItsOwn) {
  const auto cases = blind::plan_cases(small(24, 8, 6, 20));
  ASSERT_EQ(cases.size(), 59u);
  std::map<std::size_t, int> by_effects;
  std::set<std::string> seeds, salts;
  for (const auto& c : cases) {
    ++by_effects[c.label.effects.size()];
    seeds.insert(c.label.seed), salts.insert(c.label.salt);
    const std::set<std::string> different(c.label.effects.begin(), c.label.effects.end());
    EXPECT_EQ(different.size(), c.label.effects.size()) << c.label.seed;
  }
  EXPECT_EQ(by_effects[0], 6);
  EXPECT_EQ(by_effects[1], 33);
  EXPECT_EQ(by_effects[2], 20);
  EXPECT_EQ(seeds.size(), cases.size());
  EXPECT_EQ(salts.size(), cases.size());
}

TEST(CasePlan, NamesCasesInAnOrderThatIsNotThatOfTheirSeeds) {
  int rising = 0;
  const auto cases = blind::plan_cases(small(60, 0, 40, 0));
  for (std::size_t i = 1; i < cases.size(); ++i) rising += cases[i - 1].seed < cases[i].seed ? 1 : 0;
  EXPECT_NEAR(rising, 50, 15);  // of 100 neighbours, five standard deviations
}

TEST(BlindMake, WritesRecordingsThatTellNothingButInputAndMotor) {
  const SealedCheck check;
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(check.folder())) files.insert(entry.path().filename());
  EXPECT_EQ(files.size(), 2u + 3u * 5u) << "a manifest, a list, three files a case";
  const std::string csv = text_of(check.folder() + "/case_001_train.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "t,u,x1");
  for (const BlindLabel& label : read_blind_labels(check.labels()).cases)
    for (const std::string& file : files)
      for (const std::string& effect : label.effects)
        EXPECT_EQ(text_of(check.folder() + "/" + file).find(effect), std::string::npos) << file;
}

TEST(BlindMake, WritesSheetsThatTheDiagnosisTakesAsTheyAre) {
  const SealedCheck check;
  const Configuration c = load_configuration(check.folder() + "/case_001.yaml");
  EXPECT_NO_THROW(require_reference_model(c));
  ASSERT_EQ(c.recording->held_out.size(), 1u);
  EXPECT_GT(read_recording(c.recording->held_out[0].path).size(), 5000u);
  EXPECT_TRUE(c.model.effects.empty());
}

TEST(BlindMake, IsAFunctionOfItsConfigurationForAnyNumberOfThreads) {
  const SealedCheck check;
  const testing::TemporaryFile place("");
  make_blind_check(small(1, 1, 1, 1), (place.folder() / "cases").string(),
                   (place.folder() / "labels.json").string(), 1);
  EXPECT_EQ(text_of(place.folder() / "labels.json"), text_of(check.labels()));
  EXPECT_EQ(text_of(place.folder() / "cases/manifest.json"), text_of(check.folder() + "/manifest.json"));
}

TEST(BlindMake, RefusesToPutTheLabelsAmongTheRecordings) {
  const testing::TemporaryFile place("");
  const std::string folder = (place.folder() / "cases").string();
  EXPECT_THAT(refusal([&] { make_blind_check(small(1, 0, 0, 0), folder, folder + "/labels.json", 1); }),
              HasSubstr("expected a place apart"));
}

TEST(Seal, HoldsForWhatWasMade) {
  const SealedCheck check;
  EXPECT_NO_THROW(verify_recordings(check.manifest(), check.folder()));
  EXPECT_NO_THROW(verify_labels(check.manifest(), read_blind_labels(check.labels()), check.labels()));
}

TEST(Seal, RefusesAChangedLabel) {
  const SealedCheck check;
  const BlindLabels labels = read_blind_labels(check.labels());
  const auto changes = std::vector<void (*)(BlindLabel&)>{
      [](BlindLabel& l) {
        l.effects = {"gap_growth", "input_delay"};
      },
      [](BlindLabel& l) { l.severity += 1e-9; }, [](BlindLabel& l) { l.rig = "heavy"; },
      [](BlindLabel& l) { l.salt[0] ^= 1; },
      [](BlindLabel& l) { l.part = l.part == "report" ? "calibration" : "report"; }};
  for (const auto change : changes) {
    BlindLabels changed = labels;
    change(changed.cases[2]);
    EXPECT_THAT(refusal([&] { verify_labels(check.manifest(), changed, "labels.json"); }),
                AllOf(HasSubstr("labels.json: "), HasSubstr("case_003")));
  }
  BlindLabels fewer = labels;
  fewer.cases.pop_back();
  EXPECT_THAT(refusal([&] { verify_labels(check.manifest(), fewer, "labels.json"); }), HasSubstr("4 cases"));
}

TEST(Seal, RefusesASwappedRecordingAndAChangedSheet) {
  const SealedCheck check;
  const fs::path folder = check.folder();
  fs::rename(folder / "case_001_train.csv", folder / "kept.csv");
  fs::copy(folder / "case_002_train.csv", folder / "case_001_train.csv");
  EXPECT_THAT(refusal([&] { verify_recordings(check.manifest(), check.folder()); }),
              AllOf(HasSubstr("case_001_train.csv"), HasSubstr("sealed")));
  fs::rename(folder / "kept.csv", folder / "case_001_train.csv");
  std::ofstream(folder / "case_004.yaml", std::ios::app) << "# a word\n";
  EXPECT_THAT(refusal([&] { verify_recordings(check.manifest(), check.folder()); }),
              HasSubstr("case_004.yaml"));
}

TEST(Seal, NoTwoTruthsHaveOneHash) {
  BlindLabel a;
  a.name = "case_001", a.part = "report", a.effects = {"cogging_torque"}, a.salt = "0123456789abcdef",
  a.seed = "7";
  const auto hash_with = [&](auto change) {
    BlindLabel b = a;
    change(b);
    return label_hash(b);
  };
  // As they ran into each other while fields were joined by line ends and effects by '+'.
  EXPECT_NE(hash_with([](BlindLabel& l) { l.rig = "paper\nnull\nnull"; }),
            hash_with([](BlindLabel& l) { l.rig = "paper", l.seed = "null\n7"; }));
  EXPECT_NE(hash_with([](BlindLabel& l) { l.effects = {"a+b"}; }), hash_with([](BlindLabel& l) {
              l.effects = {"a", "b"};
            }));
  EXPECT_NE(hash_with([](BlindLabel& l) { l.effects = {""}; }),
            hash_with([](BlindLabel& l) { l.effects = {}; }));
}

TEST(Seal, RefusesWordsThatCouldBeReadInTwoWays) {
  const SealedCheck check;
  const BlindLabels labels = read_blind_labels(check.labels());
  const auto changes = std::vector<void (*)(BlindLabel&)>{
      [](BlindLabel& l) { l.effects = {"a+b"}; },  [](BlindLabel& l) { l.effects = {""}; },
      [](BlindLabel& l) { l.effects = {"a\nb"}; }, [](BlindLabel& l) { l.rig = "paper\n"; },
      [](BlindLabel& l) { l.salt += "\n"; },       [](BlindLabel& l) { l.seed = "1\n2"; }};
  for (const auto change : changes) {
    BlindLabels changed = labels;
    change(changed.cases[0]);
    write_blind_labels(check.labels(), changed);
    EXPECT_THAT(refusal([&] { seal_blind_check(check.folder(), check.labels()); }),
                HasSubstr("control character"));
  }
}

TEST(Seal, HoldsNameAndConfigurationToo) {
  const SealedCheck check;
  for (const bool name : {true, false}) {
    BlindLabels changed = read_blind_labels(check.labels());
    (name ? changed.name : changed.configuration) += "9";
    EXPECT_THAT(refusal([&] { verify_labels(check.manifest(), changed, "labels.json"); }),
                HasSubstr("another name or configuration than those that were sealed"));
  }
}

TEST(Seal, ReachesNoFileOutsideTheFolder) {
  const SealedCheck check;
  BlindManifest manifest = check.manifest();
  manifest.cases[0].files[1].file = "../labels.json";
  EXPECT_THAT(refusal([&] { verify_recordings(manifest, check.folder()); }),
              HasSubstr("'../labels.json', expected one in the folder that is handed out"));
  manifest = check.manifest();
  manifest.name = "../../elsewhere";
  EXPECT_THAT(refusal([&] { verify_recordings(manifest, check.folder()); }),
              HasSubstr("expected a plain file name"));
}

TEST(Seal, TakesOwnRecordingsAndRefusesLabelsThatAreIncomplete) {
  const SealedCheck check;
  BlindLabels labels = read_blind_labels(check.labels());
  const auto sealed = [&] {
    write_blind_labels(check.labels(), labels);
    return refusal([&] { seal_blind_check(check.folder(), check.labels()); });
  };
  labels.cases[0].seed = "", labels.cases[0].severity = kNaN, labels.cases[0].effects = {"a bent shaft"};
  EXPECT_THAT(sealed(), HasSubstr("manifest.json: is there and seals something else"));
  fs::remove(check.folder() + "/manifest.json");
  EXPECT_EQ(sealed(), "");
  EXPECT_EQ(sealed(), "") << "the same once more";
  EXPECT_NO_THROW(verify_labels(check.manifest(), read_blind_labels(check.labels()), check.labels()));
  labels.cases[0].salt = "short";
  EXPECT_THAT(sealed(), HasSubstr("salt of 5 characters, expected at least 16"));
  labels.cases[0].salt = labels.cases[1].salt, labels.cases[0].name = "case_002";
  EXPECT_THAT(sealed(), HasSubstr("case_002 twice"));
  labels.cases[0].name = "../case_001";
  EXPECT_THAT(sealed(), HasSubstr("expected a name of"));
  labels.cases[0].name = "case_009";
  EXPECT_THAT(sealed(), HasSubstr("case_009.yaml"));
}

TEST(Seal, TakesNoManifestsPlaceThatSealsAnotherNameOrConfiguration) {
  for (const bool name : {true, false}) {
    const SealedCheck check;
    const std::string before = text_of(check.folder() + "/manifest.json");
    BlindLabels labels = read_blind_labels(check.labels());
    (name ? labels.name : labels.configuration) += "9";
    write_blind_labels(check.labels(), labels);
    EXPECT_THAT(refusal([&] { seal_blind_check(check.folder(), check.labels()); }),
                HasSubstr("manifest.json: is there and seals something else"));
    EXPECT_EQ(text_of(check.folder() + "/manifest.json"), before);
  }
}

TEST(Seal, RefusesTruthsThatNobodyCouldMean) {
  const auto changes = std::vector<void (*)(BlindLabel&)>{[](BlindLabel& l) { l.severity = 5.0; },
                                                          [](BlindLabel& l) { l.severity = -0.1; },
                                                          [](BlindLabel& l) { l.cycles_per_turn = -3.0; },
                                                          [](BlindLabel& l) {
                                                            l.effects = {"input_delay", "input_delay"};
                                                          },
                                                          [](BlindLabel& l) {
                                                            l.effects = {"a", "b", "c"};
                                                          }};
  const SealedCheck check;
  const BlindLabels labels = read_blind_labels(check.labels());
  for (const auto change : changes) {
    BlindLabels changed = labels;
    change(changed.cases[0]);
    write_blind_labels(check.labels(), changed);
    fs::remove(check.folder() + "/manifest.json");
    EXPECT_THAT(refusal([&] { seal_blind_check(check.folder(), check.labels()); }), HasSubstr(", expected "));
  }
  write_blind_labels(check.labels(), {labels.name, labels.configuration, {}});
  EXPECT_THAT(refusal([&] { seal_blind_check(check.folder(), check.labels()); }),
              HasSubstr("labels no case"));
}

TEST(BlindMake, SealsNoTruthThatItDidNotDraw) {
  const SealedCheck check;
  BlindLabels labels = read_blind_labels(check.labels());
  for (BlindLabel& label : labels.cases)
    if (label.effects.size() == 1) label.effects = {"a_bent_shaft"};
  write_blind_labels(check.labels(), labels);
  const std::string before = text_of(check.labels());
  EXPECT_THAT(refusal([&] { make_blind_check(small(1, 1, 1, 1), check.folder(), check.labels(), 2); }),
              HasSubstr("holds other labels of small"));
  EXPECT_EQ(text_of(check.labels()), before);
}

}  // namespace
}  // namespace gapscope
