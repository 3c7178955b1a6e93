// When later steps count, by their numbers alone; the whole search runs in test_diagnosis.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/further.h"
#include "diagnosis/open_question.h"

namespace gapscope::internal::diagnosis {
namespace {

ScoredModel model(double score, double median, double mean_cost) {
  ScoredModel j;
  j.score = score;
  j.median_free = j.median_innovation = median;
  j.fitted.mean_cost = mean_cost;
  return j;
}

/// Two effects, the second one accepted or not, that leave `after`.
Additions two(bool second_accepted, const ScoredModel& after, double margin = 2.0) {
  Additions a;
  a.effects.resize(2);
  a.steps.resize(1);
  a.steps.front().decision.accepted = second_accepted;
  a.steps.front().decision.margin = margin;
  a.after = after;
  return a;
}

TEST(FurtherSteps, BearOutAnUnsureFirstOneThatTheyLeadFromToTheFloorOrNearIt) {
  const ScoredModel before = model(7.0, 180.0, 1e4);
  EXPECT_TRUE(borne_out(before, two(true, model(1.7, 2.5, 4.0))));
  EXPECT_TRUE(borne_out(before, two(true, model(0.3, 1.1, 1.0))));
  EXPECT_TRUE(borne_out(before, two(true, model(0.3, 1.1, 1.0), 0.4)));
  EXPECT_FALSE(borne_out(before, two(true, model(1.7, 2.5, 4.0), 0.4))) << "a second step that is not clear";
  EXPECT_FALSE(borne_out(before, two(true, model(3.0, 40.0, 600.0)))) << "a fifth is left";
  EXPECT_FALSE(borne_out(before, two(true, model(2.0, 5.0, 20.0)))) << "two steps, and a fortieth is left";
  ScoredModel drifting = model(2.0, 5.0, 20.0);
  drifting.median_innovation = 1.1;
  EXPECT_TRUE(borne_out(before, two(true, drifting))) << "predicted to the floor";
  EXPECT_FALSE(borne_out(before, two(false, model(0.3, 1.1, 1.0)))) << "no second step was taken";
}

TEST(FurtherSteps, BeginWhereTheHeldOutErrorShrinksOrWhereMuchOfTheFitIsExplained) {
  FirstSearch found;
  found.before = model(12.0, 1600.0, 1e4);
  found.candidates = {model(11.0, 1500.0, 9.5e3), model(11.95, 1550.0, 9e3), model(12.0, 1300.0, 6e3),
                      model(12.1, 2400.0, 5e3), model(12.2, 2400.0, 4e3)};
  for (ScoredModel& c : found.candidates) c.windows_better = 1.0;
  const auto chosen = branches(found);
  ASSERT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen[0], &found.candidates[0]);
  EXPECT_EQ(chosen[1], &found.candidates[4]);
  EXPECT_EQ(chosen[2], &found.candidates[3]);
}

TEST(FurtherSteps, LeaveNoQuestionOnTopOfEffectsThatWereNotAdded) {
  Additions a = two(true, model(1.0, 2.0, 4.0), 0.1);
  FurtherStep& step = a.steps.front();
  step.before = model(4.0, 100.0, 1e4);
  step.candidates = {model(3.0, 50.0, 3e3), model(3.05, 51.0, 3e3)};
  step.candidates[0].entry = find_effect("torque_ripple");
  step.candidates[1].entry = find_effect("constant_load_torque");
  step.decision.gain = 1.0;
  a.accepted = true;
  EXPECT_EQ(open_question({}, a).size(), 2u);
  a.accepted = false;
  EXPECT_TRUE(open_question({}, a).empty());
}

TEST(FurtherSteps, DoNotBearOutAFirstOneThatStandsAlone) {
  Additions a = two(true, model(0.3, 1.1, 1.0));
  a.steps.clear();
  EXPECT_FALSE(borne_out(model(7.0, 180.0, 1e4), a));
}

TEST(FurtherSteps, BearOutTheFirstOneWhereOneSetOfNumbersExplainsAllRecordings) {
  Additions a = two(true, model(4.0, 30.0, 1.2));
  a.explained = true;
  EXPECT_TRUE(borne_out(model(7.0, 180.0, 1e4), a));
}

TEST(FurtherSteps, CountFarFromTheFloorWhereTheyAreClearInEveryRespect) {
  const auto accepted = [](double gain, double lead, double windows, double fitted) {
    const ScoredModel before = model(7.0, 110.0, 5000.0);
    ScoredModel best = model(7.0 - gain, 60.0, fitted), other = model(7.0 - gain + lead, 80.0, fitted);
    best.entry = find_effect("quadratic_drag"), other.entry = find_effect("cogging_torque");
    best.windows_better = windows;
    return decide({best, other}, before, Reach::kAnyGain, {}).accepted;
  };
  EXPECT_TRUE(accepted(0.5, 0.4, 0.7, 1300.0));
  EXPECT_FALSE(accepted(0.25, 0.4, 0.7, 1300.0)) << "gain";
  EXPECT_FALSE(accepted(0.5, 0.2, 0.7, 1300.0)) << "lead";
  EXPECT_FALSE(accepted(0.5, 0.4, 0.5, 1300.0)) << "windows";
  EXPECT_FALSE(accepted(0.5, 0.4, 0.7, 4980.0)) << "what was fitted does not ask for it";
}

ScoredModel with(const char* effect, double score, double median) {
  ScoredModel j = model(score, median, 1.0);
  j.entry = find_effect(effect);
  return j;
}

TEST(Decision, HasAllThatReachTheFloorInOneGroupBesideATorqueBalance) {
  const ScoredModel before = model(5.0, 40.0, 5000.0);
  const ScoredModel best = with("stribeck_friction", 0.1, 1.0), far = with("cogging_torque", 3.0, 10.0);
  const auto decided = [&](double score, double median) {
    return decide_among_equals({best, with("input_dead_zone", score, median), far}, before, Reach::kFloor,
                               {});
  };
  const Decision both = decided(0.3, 1.2);
  EXPECT_TRUE(both.accepted);
  EXPECT_EQ(both.group, (std::vector{best.entry, find_effect("input_dead_zone")}));
  EXPECT_NEAR(both.margin, 2.9, 1e-12) << "to the first that does not reach it";
  EXPECT_FALSE(decided(0.3, 1.4).accepted) << "one that comes near it";
  EXPECT_TRUE(decided(0.45, 1.2).accepted);
  EXPECT_EQ(decided(0.45, 1.2).group.size(), 1u) << "what a recording tells apart at the floor, too";
}

torque_view::Budget led_by(std::initializer_list<const char*> laws) {
  torque_view::Budget budget;
  torque_view::Rung& rung = budget.rungs.emplace_back();
  for (const char* name : laws) {
    torque_view::Candidate c;
    c.law = &torque_view::law(name);
    c.evidence.share = 0.5;
    rung.ranking.push_back(c);
  }
  return budget;
}

TEST(TorqueBalance, HasTheSimulatorAskedForWhatItCannotTellApart) {
  const DiagnosisOptions options;
  Study study{{}, {}, {}, {}, 3.0, 0.0, {}, options};
  for (const EffectEntry* entry : effect_table()) study.catalogue.push_back(entry);
  const auto asked =
      worth_refitting(study, led_by({"stribeck_friction", "presliding_friction", "constant_load_torque",
                                     "viscous_drift", "cogging_torque"}));
  const auto is_asked = [&](const char* name) {
    return std::find(asked.begin(), asked.end(), find_effect(name)) != asked.end();
  };
  EXPECT_TRUE(is_asked("stribeck_friction"));
  EXPECT_TRUE(is_asked("motor_coulomb_friction")) << "within Stribeck's";
  EXPECT_TRUE(is_asked("supply_sag")) << "no law of the balance";
  EXPECT_TRUE(is_asked("torque_saturation")) << "which a sagging supply may stand for";
  EXPECT_FALSE(is_asked("encoder_eccentricity"));
  EXPECT_FALSE(is_asked("load_inertia_variation")) << "a look-alike of one that the balance has told it from";
}

}  // namespace
}  // namespace gapscope::internal::diagnosis
