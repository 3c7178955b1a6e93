#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "blind/scored_answer.h"
#include "results/blind_score.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;

/// A check that is answered by hand.
class Check {
 public:
  void add(std::vector<std::string> truth, const std::string& verdict, std::vector<std::string> named,
           std::vector<std::string> group, const std::string& part = "report") {
    BlindLabel l;
    l.name = "case_" + std::to_string(labels.cases.size());
    l.part = part, l.effects = std::move(truth), l.rig = "paper", l.severity = 0.5;
    labels.cases.push_back(l);
    BlindAnswer a;
    a.name = l.name, a.verdict = verdict, a.effects = std::move(named), a.group = std::move(group);
    a.shrink = 0.9;
    a.evidence.nominal = {"", 5.0, 100.0, 30.0, 30.0, kNaN};
    a.headline = "in engagement";
    answers.cases.push_back(a);
  }
  /// Scores S of the last case's candidates; the nominal model has 5.
  void candidates(const std::vector<std::pair<std::string, double>>& list) {
    for (const auto& [effect, score] : list)
      answers.cases.back().evidence.candidates.push_back({effect, score, 1.0, 1.0, 1.0, 1.0});
  }
  BlindScore score() const { return score_blind_answers(labels, answers); }

  BlindLabels labels;
  BlindAnswers answers;
};

const BlindCount& count_of(const BlindScore& s, const std::string& name) {
  for (const BlindCount& c : s.counts)
    if (c.name == name) return c;
  ADD_FAILURE() << "no count of " << name;
  static const BlindCount none;
  return none;
}

std::pair<int, int> counted(const BlindScore& s, const std::string& name) {
  const BlindCount& c = count_of(s, name);
  return {c.count, c.of};
}

using Of = std::pair<int, int>;

TEST(BlindScore, CountsWhatWasNamedAmongWhatCouldBeSeen) {
  Check check;
  check.add({"quadratic_drag"}, "effect", {"quadratic_drag"}, {"quadratic_drag"});
  check.candidates({{"quadratic_drag", 0.0}, {"input_delay", 3.0}});
  check.add({"quadratic_drag"}, "effect", {"torque_saturation"}, {"torque_saturation", "quadratic_drag"});
  check.candidates({{"torque_saturation", 0.0}, {"quadratic_drag", 0.1}, {"input_delay", 3.0}});
  check.add({"quadratic_drag"}, "effect", {"input_delay"}, {"input_delay"});
  check.candidates({{"input_delay", 0.0}, {"quadratic_drag", 2.0}});
  check.add({"quadratic_drag"}, "none", {}, {});
  check.answers.cases.back().evidence.nominal.median_free = 1.1;
  check.answers.cases.back().evidence.nominal.median_innovation = 1.0;
  check.add({"quadratic_drag"}, "effect", {"input_delay"}, {"input_delay"}, "calibration");
  const BlindScore s = check.score();
  EXPECT_EQ(counted(s, "one effect: first or in the group"), Of(2, 3));
  EXPECT_EQ(counted(s, "one effect: first of the ranking"), Of(1, 3));
  EXPECT_EQ(counted(s, "one effect: among the first three"), Of(3, 3));
  EXPECT_EQ(counted(s, "one effect: named"), Of(2, 3));
  EXPECT_EQ(counted(s, "one effect: another one named"), Of(1, 3));
  EXPECT_EQ(s.report_cases, 4);
  EXPECT_EQ(s.calibration_cases, 1);
  ASSERT_EQ(s.confusion.size(), 3u);
  for (const ConfusionCell& c : s.confusion)  // the group of the second holds the truth
    EXPECT_EQ(c.count, c.answer == "quadratic_drag" ? 2 : 1) << c.answer;
}

TEST(BlindScore, CountsFalseAlarmsAndWhatIsOutsideTheCatalogue) {
  Check check;
  check.add({}, "none", {}, {});
  check.add({}, "effect", {"input_delay"}, {"input_delay"});
  check.add({"gremlins"}, "unknown", {}, {});
  check.add({"gremlins"}, "effect", {"input_delay"}, {"input_delay"});
  const BlindScore s = check.score();
  EXPECT_EQ(counted(s, "no effect: none"), Of(1, 2));
  EXPECT_EQ(counted(s, "no effect: one blamed"), Of(1, 2));
  EXPECT_EQ(counted(s, "outside the catalogue: unknown"), Of(1, 2));
}

TEST(BlindScore, AsksOnceMoreWithoutTheTruthAndItsLookAlikes) {
  Check check;
  check.add({"input_delay"}, "effect", {"input_delay"}, {"input_delay"});
  check.candidates({{"input_delay", -1.0}, {"actuator_lag", 0.0}, {"quadratic_drag", 4.5}});
  check.add({"input_delay"}, "effect", {"input_delay"}, {"input_delay"});
  check.candidates({{"input_delay", -1.0}, {"quadratic_drag", 0.0}, {"actuator_lag", 4.5}});
  const BlindScore s = check.score();
  EXPECT_EQ(counted(s, "truth taken out: another effect blamed"), Of(2, 2));
  EXPECT_EQ(counted(s, "truth and look-alikes taken out: no other effect blamed"), Of(1, 2));
}

TEST(BlindScore, CountsPairsAsFoundWhereBothAreNamed) {
  Check check;
  check.add({"input_delay", "quadratic_drag"}, "effect", {"quadratic_drag", "actuator_lag"},
            {"quadratic_drag"});
  check.add({"input_delay", "quadratic_drag"}, "effect", {"quadratic_drag", "input_delay"},
            {"quadratic_drag"});
  check.add({"input_delay", "quadratic_drag"}, "effect", {"actuator_lag", "quadratic_drag"},
            {"actuator_lag", "input_delay"});
  check.add({"input_delay", "quadratic_drag"}, "unknown", {}, {});
  const BlindScore s = check.score();
  EXPECT_EQ(counted(s, "two effects: both named"), Of(2, 4));
  EXPECT_EQ(counted(s, "two effects: these and no other"), Of(2, 4));
  EXPECT_EQ(counted(s, "two effects: a wrong one among those named"), Of(1, 4));
}

TEST(BlindScore, CountsNoEffectThatHasGivenItsPlaceToTheLawThatContainsIt) {
  Check check;
  check.add({"stribeck_friction", "input_delay"}, "effect",
            {"motor_coulomb_friction", "stribeck_friction", "input_delay"}, {"motor_coulomb_friction"});
  check.add({"quadratic_drag", "input_delay"}, "effect",
            {"motor_coulomb_friction", "quadratic_drag", "input_delay"}, {"motor_coulomb_friction"});
  const BlindScore s = check.score();
  EXPECT_EQ(counted(s, "two effects: both named"), Of(2, 2));
  EXPECT_EQ(counted(s, "two effects: these and no other"), Of(1, 2));
  EXPECT_EQ(counted(s, "two effects: a wrong one among those named"), Of(1, 2));
}

TEST(BlindScore, IsReadBackAsItWasWritten) {
  Check check;
  check.add({"quadratic_drag"}, "effect", {"quadratic_drag"}, {"quadratic_drag"});
  check.candidates({{"quadratic_drag", 0.0}, {"input_delay", 3.0}});
  const testing::TemporaryFile place("");
  const BlindScore s = check.score();
  write_blind_score(place.folder().string(), s);
  const BlindScore read = read_blind_score(place.folder().string());
  EXPECT_EQ(read.counts.size(), s.counts.size());
  EXPECT_EQ(counted(read, "one effect: named"), Of(1, 1));
  EXPECT_EQ(read.confusion.size(), s.confusion.size());
  EXPECT_EQ(read.abstention.size(), s.abstention.size());
  EXPECT_DOUBLE_EQ(read.cases[0].shrink, 0.9);
}

/// Decisions that come true by a law of the calibrated form.
std::vector<blind::Judgement> judgements(int count, std::uint64_t seed) {
  auto g = random_stream(seed, "judgements");
  std::vector<blind::Judgement> all;
  for (int i = 0; i < count; ++i) {
    StepOutcome o;
    o.ranking = {"quadratic_drag"};
    o.rel = uniform(g, 0.0, 1.0), o.margin = uniform(g, 0.0, 2.0), o.gain = uniform(g, 0.1, 5.0);
    o.probability = 0.5;
    const double z = -3.0 + 4.0 * o.rel + std::log(o.margin + 0.05) + 0.5 * std::log(o.gain);
    all.push_back({o, uniform(g, 0.0, 1.0) < 1.0 / (1.0 + std::exp(-z))});
  }
  return all;
}

TEST(BlindCalibration, LearnsFromOnePartWhatHoldsOnTheOther) {
  const BlindCalibration c = blind::calibrate(judgements(4000, 1), judgements(4000, 2));
  ASSERT_EQ(c.weights.size(), 4u);
  EXPECT_NEAR(c.weights[0], -3.0, 0.6);  // three standard deviations of 4000 cases
  EXPECT_NEAR(c.weights[1], 4.0, 0.5);
  EXPECT_LT(c.error, 0.03);  // eight bins of 500, each within 0.02
  EXPECT_GT(c.error_before, 0.1);
  EXPECT_LT(c.brier, c.brier_before);
}

TEST(BlindCalibration, LeavesProbabilitiesAloneThatItHasTooFewCasesFor) {
  const BlindCalibration c = blind::calibrate(judgements(20, 1), judgements(100, 2));
  EXPECT_TRUE(c.weights.empty());
  EXPECT_EQ(c.error, c.error_before);
}

TEST(BlindCalibration, IsRightMoreOftenTheMoreItAbstains) {
  const auto judged = judgements(4000, 2);
  const auto points = blind::abstention_of(judged, blind::calibrate(judgements(4000, 1), judged));
  const auto right = [&](std::size_t i) { return static_cast<double>(points[i].right) / points[i].answered; };
  EXPECT_EQ(points[0].answered, 4000);
  EXPECT_GT(right(10), right(0) + 0.1);
  EXPECT_GT(right(16), right(10));
}

}  // namespace
}  // namespace gapscope
