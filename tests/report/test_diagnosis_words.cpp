// The report of a diagnosis does not contradict itself.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "report/diagnosis_figures.h"
#include "report/error_budget.h"
#include "results/scratch_folder.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::line_with;
using ::testing::Not;

/// One body of which the budget knows friction.
DiagnosisResult with_friction() {
  DiagnosisResult r;
  ErrorBudget& b = r.diagnosis.budget;
  b.band_hz = 8.0, b.input = 1.0, b.nominal = 0.1, b.with_effects = b.remains = 0.036, b.encoder = 0.004;
  b.rungs = {{"motor_coulomb_friction",
              "motor_coulomb_friction",
              true,
              0.1,
              0.036,
              0.8,
              {0.7, 0.9},
              0.8,
              0.8,
              kNaN}};
  r.diagnosis.effects = {"motor_coulomb_friction"};
  return r;
}

TEST(DiagnosisWords, RecordingsThatDisagreeByMoreThanAModelLeavesAreNoFloor) {
  DiagnosisResult r = with_friction();
  r.diagnosis.budget.records = 0.044;
  const std::string text = internal::report::budget_table(r);
  EXPECT_TOLD(line_with(text, "Floors, which no model"));
  r.diagnosis.budget.encoder = kNaN;
  EXPECT_THAT(internal::report::budget_table(r), Not(HasSubstr("no model gets below")));
}

TEST(DiagnosisWords, ACauseOnTopOfAnOpenOneIsEstablishedWithThat) {
  DiagnosisResult r = with_friction();
  AddedEffect friction, delay;
  friction.effect = "motor_coulomb_friction", friction.parameters = {{"level_nm", "N m", 0.1}};
  delay.effect = "input_delay", delay.parameters = {{"delay_s", "s", 0.01}};
  delay.established = true;
  r.diagnosis.added = {friction, delay};
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_THAT(text, HasSubstr("| `motor_coulomb_friction` (cause open) |"));
  EXPECT_TOLD(line_with(text, "| `input_delay` (established with"));
}

TEST(DiagnosisWords, TheRankingSaysWhichRowTheCardTookAndWhy) {
  DiagnosisResult r = with_friction();
  r.diagnosis.outside_probability = 0.5;
  r.diagnosis.ranking.resize(2);
  r.diagnosis.ranking[0].effect = "backlash";
  r.diagnosis.ranking[1].effect = "motor_coulomb_friction", r.diagnosis.ranking[1].remark = "at a bound";
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_TOLD(line_with(text, "the error budget did,"));
  EXPECT_THAT(text, HasSubstr("It begins with `motor_coulomb_friction`"));
  EXPECT_TOLD(line_with(text, "| **in the card**;"));
  EXPECT_THAT(text, Not(HasSubstr("Not in this table")));
  r.diagnosis.effects.emplace_back("load_dependent_friction");
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "Not in this table,"));
  EXPECT_THAT(internal::report::diagnosis_ranking(r).reading,
              HasSubstr("decides, for motor Coulomb friction"));
  const auto panels = internal::report::diagnosis_figures(r).front().panels;
  const auto is_of_budget = [](const auto& panel) { return panel.title == "Shares of the error budget"; };
  EXPECT_TRUE(std::any_of(panels.begin(), panels.end(), is_of_budget)) << "what decided is on the sheet";
}

TEST(DiagnosisWords, WhatIsMissingAndWhatCorrectsTheObserverHaveNamesOfTheirOwn) {
  DiagnosisResult r = with_friction();
  r.diagnosis.measures = {{"residual torque", "N m", 0.2, 0.1, kNaN}};
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_TOLD(line_with(text, "Missing torque: what the"));
  EXPECT_TOLD(line_with(text, "| correcting torque |"));
  EXPECT_THAT(text, Not(HasSubstr("esidual torque")));
  EXPECT_EQ(internal::report::diagnosis_budget(r).title, "Error budget: missing torque on held-out data");
}

/// The waterfall ends with all laws, the card with those that the model can have.
TEST(DiagnosisWords, TheBudgetsFigureTellsTheTorqueOfTheModelBesideThatOfAllLaws) {
  DiagnosisResult r = with_friction();
  EXPECT_TOLD(internal::report::diagnosis_budget(r).reading);
  r.diagnosis.budget.remains = 0.02;
  r.diagnosis.budget.rungs.push_back({"resonance", "", false, 0.036, 0.02, 0.7, {0.6, 0.8}, 0.1, 0.7, kNaN});
  EXPECT_TOLD(internal::report::diagnosis_budget(r).reading);
}

TEST(DiagnosisWords, WhatTheBudgetNamedRestsOnIt) {
  DiagnosisResult r = with_friction();
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "The answer rests on"));
  r.diagnosis.budget.rungs.clear();
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "The answer rests on"));
}

TEST(DiagnosisWords, WhatEndedAtABoundIsNoBias) {
  DiagnosisResult r = with_friction();
  r.diagnosis.blame = {{"motor_damping", "N m s/rad", 0.0, 0.023, BoundReached::kLower},
                       {"motor_inertia", "kg m^2", 0.02, 0.04}};
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_TOLD(line_with(text, "| `motor_damping` | at"));
  EXPECT_THAT(text, HasSubstr("| 50 % low |"));
  r.diagnosis.blame.front() = {"motor_damping",     "N m s/rad",         0.1, 5.0,
                               BoundReached::kNone, BoundReached::kUpper};
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "| at its upper"));
}

TEST(DiagnosisWords, ARankingWithoutProbabilitiesHasNoColumnOfThem) {
  DiagnosisResult r = with_friction();
  r.diagnosis.ranking.resize(1);
  r.diagnosis.ranking[0].effect = "motor_coulomb_friction";
  std::string text = internal::report::diagnosis_text(r);
  EXPECT_THAT(text, Not(HasSubstr("| effect | probability |")));
  EXPECT_TOLD(line_with(text, "None has a probability:"));
  r.diagnosis.ranking[0].probability = 0.9, r.diagnosis.outside_probability = 0.1;
  EXPECT_THAT(internal::report::diagnosis_text(r), HasSubstr("| effect | probability |"));
}

TEST(DiagnosisWords, TheTableOfSizesHasTheWholeFreeRun) {
  DiagnosisResult r = with_friction();
  r.diagnosis.whole_run = WholeRun{0.407, 0.0412, 0.876};
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "| largest error of"));
}

TEST(DiagnosisWords, TheSpeedOfAPlaceIsToldToBeTheObservers) {
  DiagnosisResult r = with_friction();
  r.diagnosis.where.mode = {{"gap", 0.9, 0.5}, {"engagement", 0.1, 0.5}};
  r.diagnosis.where.speed = {{"0..1 rad/s", 0.9, 0.5}, {"1..2 rad/s", 0.1, 0.5}};
  std::string titles;
  for (const auto& panel : internal::report::diagnosis_where(r).panels) titles += panel.title + "; ";
  EXPECT_THAT(titles, HasSubstr("Speed (the observer's estimate)"));
}

/// The same where nothing is missing.
DiagnosisResult at_the_floor() {
  DiagnosisResult r = with_friction();
  Diagnosis& d = r.diagnosis;
  d.verdict = DiagnosisVerdict::kNone, d.sentence = "Nothing is missing.";
  d.effects.clear(), d.budget.rungs.clear();
  d.budget.nominal = d.budget.remains = d.budget.with_effects = 4.91e-3, d.budget.input = 0.2;
  d.measures = {{"free run restarted every 0.5 s", "rad", 2e-3, 2e-3, 2e-5}};
  return r;
}

TEST(DiagnosisWords, TheRankingSaysWhatItRanksAndItsAxisFitsSmallShares) {
  DiagnosisResult r = with_friction();
  for (const double rel : {0.9, 0.05}) {
    r.diagnosis.ranking.emplace_back().effect = "cogging_torque";
    r.diagnosis.ranking.back().rel = rel;
  }
  auto panel = internal::report::diagnosis_ranking(r).panels[0];
  EXPECT_EQ(panel.title, "Each alone, free run, first step");
  EXPECT_EQ(panel.x.name, "share of the way to the encoder floor");
  EXPECT_GT(panel.x.range.high, 1.0);
  EXPECT_EQ(panel.x_marks.size(), 2u);
  r.diagnosis.ranking.front().rel = 0.062, r.diagnosis.ranking.back().rel = 0.0586;
  panel = internal::report::diagnosis_ranking(r).panels[0];
  EXPECT_LT(panel.x.range.high, 0.1);
  EXPECT_EQ(panel.y.remarks[1], "0.059");
  EXPECT_EQ(panel.x_marks.size(), 1u) << "the floor is outside";
}

TEST(DiagnosisWords, WhereNothingWasAddedNoColumnAndNoFallTellsOfIt) {
  const DiagnosisResult r = at_the_floor();
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_TOLD(line_with(text, "| measure (median over"));
  EXPECT_THAT(text, Not(HasSubstr("with all that was added")));
  const auto figure = internal::report::diagnosis_budget(r);
  EXPECT_EQ(figure.reading, "The missing torque is 4.91 mN·m, 2.5 % of what the input applies.");
  EXPECT_EQ(figure.panels[0].y.categories.size(), 1u);
}

TEST(DiagnosisWords, TellsTheNumbersThatTheRecordingsContradict) {
  DiagnosisResult r = at_the_floor();
  EXPECT_THAT(internal::report::diagnosis_text(r), Not(HasSubstr("Numbers of your model")));
  r.diagnosis.refitted = {{"motor_damping", "N m s/rad", 0.1, 0.04, {0.0399, 0.0401}}};
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "| number | the"));
  r.diagnosis.refitted.push_back({"motor_inertia", "kg m^2", 0.00781, 0.0078088, {0.0078082, 0.0078094}});
  EXPECT_THAT(internal::report::diagnosis_text(r), Not(HasSubstr("| `motor_inertia` |"))) << "reads the same";
  r.diagnosis.refitted.pop_back();
  ScratchFolder scratch;
  write_diagnosis_result(scratch.path.string(), r);
  const auto stored = read_diagnosis_result(scratch.path.string()).diagnosis.refitted;
  ASSERT_EQ(stored.size(), 1u);
  EXPECT_EQ(stored[0].key, "motor_damping");
  EXPECT_DOUBLE_EQ(stored[0].ci95.high, 0.0401);
}

TEST(DiagnosisWords, TheMapNamesTheCycleThatWasAdded) {
  DiagnosisResult r = with_friction();
  MismatchTrace& t = r.diagnosis.traces.emplace_back();
  t.dt = 1e-3;
  for (int i = 0; i < 1000; ++i) t.u.push_back(0.0), t.x1.push_back(std::sin(0.01 * i));
  t.torque_before = t.torque_after = t.error_before = t.error_after = t.x1;
  EXPECT_TOLD(line_with(internal::report::diagnosis_torque_map(r).reading, "No cycle over the"));
  AddedEffect& cogging = r.diagnosis.added.emplace_back();
  cogging.effect = "cogging_torque", cogging.parameters = {{"periods_per_turn", "1/rev", 12.0}};
  EXPECT_EQ(internal::report::diagnosis_torque_map(r).reading,
            "What was added repeats with the motor angle: cogging torque, 12 cycles per turn.");
}

}  // namespace
}  // namespace gapscope
