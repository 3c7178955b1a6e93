// What a diagnosis says that was asked to finish before its end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "base/interrupt.h"
#include "blind/blind_pair.h"
#include "diagnosis/candidates.h"
#include "diagnosis/fitted_model.h"
#include "diagnosis/step.h"
#include "diagnosis/verdict.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/telling/card.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// One candidate, which is what is missing; asked to finish as soon as the progress says `at`.
Diagnosis asked_at(const std::string& at) {
  static const blind::BlindPair pair = blind::blind_pair("geared", "motor_coulomb_friction", 0.7, 500002);
  DiagnosisOptions options;
  for (const EffectEntry* e : effect_table())
    if (e->name != std::string("motor_coulomb_friction")) options.excluded.emplace_back(e->name);
  for (const EffectEntry* e : last_resort_table()) options.excluded.emplace_back(e->name);
  options.progress = [&](const std::string& what) {
    if (what == at) request_finish();
  };
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  const FinishFirst first;
  return diagnose(train, held_out, pair.sheet, options);
}

TEST(FinishFirst, TakesOneRequestAndForgetsIt) {
  EXPECT_FALSE(may_finish_first());
  {
    const FinishFirst first;
    EXPECT_TRUE(may_finish_first());
    request_finish();
    EXPECT_TRUE(finish_requested());
    EXPECT_FALSE(may_finish_first()) << "the next one stops";
  }
  EXPECT_FALSE(finish_requested());
  EXPECT_NO_THROW(stop_point());
}

TEST(StoppedDiagnosis, OfTheNominalModelAloneTellsTheSizeAndNamesNothing) {
  const Diagnosis d = asked_at("fitting the nominal model");
  EXPECT_TRUE(d.stopped);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kUnknown);
  EXPECT_TRUE(d.ranking.empty() && d.effects.empty() && d.detectable.empty());
  EXPECT_GT(d.mismatch.before, 2.0 * d.mismatch.floor);
  EXPECT_THAT(d.warnings, ::testing::Contains(HasSubstr("stopped before its end")));
  CardFacts facts;
  facts.diagnosis = &d;
  const Card card = card_of(facts);
  EXPECT_EQ(card.codes.cause, std::vector<std::string>{"cause.stopped"});
  EXPECT_EQ(card.codes.helps, std::vector<std::string>{"helps.stopped"});
  EXPECT_EQ(card.codes.next, std::vector<std::string>{"next.finish"});
}

TEST(StoppedDiagnosis, EndsItsPresentStepAndStandsWhereThatExplainsAll) {
  const Diagnosis d = asked_at("fitting motor_coulomb_friction, 1 of 1"), whole = asked_at("");
  EXPECT_FALSE(d.stopped) << "nothing was left to look for";
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kEffect);
  EXPECT_EQ(d.effects, whole.effects);
}

TEST(StoppedDiagnosis, GivesUpALaterStepAndEndsAFirstOne) {
  using namespace internal::diagnosis;
  const blind::BlindPair pair = blind::blind_pair("geared", "motor_coulomb_friction", 0.7, 500002);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  DiagnosisOptions options;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const Study study = make_study(train, held_out, pair.sheet, options);
  const ScoredModel nominal = judge(nullptr, fit_nominal(train, pair.sheet, options.fit, study.observer_hz),
                                    study.held_out, study.observer_hz);
  const std::vector<const EffectEntry*> one = {find_effect("motor_coulomb_friction")};
  const FinishFirst first;
  request_finish();
  EXPECT_TRUE(candidates_of(study, nominal, one, false).empty());
  EXPECT_EQ(candidates_of(study, nominal, one).size(), 1u);
}

TEST(StoppedDiagnosis, LeavesCausesOpenThatFurtherStepsCouldHaveTaken) {
  using namespace internal::diagnosis;
  const DiagnosisOptions options;
  const Study study{{}, {}, {}, {}, kMeasure.slow_hz, 0.0, {}, options};
  Diagnosis found;
  found.verdict = DiagnosisVerdict::kEffect;
  found.effects = found.group = {"cogging_torque"};
  found.added = {{"cogging_torque", true, {"cogging_torque"}, kNaN, {}, 0.6, {}, 4.0}};
  Additions added;
  added.accepted = true;
  added.after.median_free = added.after.median_innovation = 20.0;
  Diagnosis open = found, balanced = found;
  tell_stopped(added, false, open);
  EXPECT_TRUE(open.stopped);
  EXPECT_EQ(open.verdict, DiagnosisVerdict::kHelps);
  EXPECT_FALSE(open.added.front().established);
  tell_stopped({}, true, balanced);
  EXPECT_TRUE(balanced.stopped && balanced.added.front().established) << "the torque balance saw its end";
  added.after.median_free = added.after.median_innovation = 1.0;
  tell_stopped(added, false, found);
  EXPECT_FALSE(found.stopped) << "at the floor";
}

TEST(StoppedDiagnosis, BeginsNoSearchForTheGap) {
  using namespace internal::diagnosis;
  const blind::BlindPair pair = blind::blind_pair("geared", "motor_coulomb_friction", 0.7, 500002);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  int searches = 0;
  DiagnosisOptions options;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  options.progress = [&](const std::string& what) {
    searches += what.starts_with("looking for the gap again");
  };
  ReferenceModel sheet = pair.sheet;
  sheet.parameters[place::kGap] = ParameterSetting::sought(kNaN);  // without a value to begin with
  const Study study = make_study(train, held_out, sheet, options);
  const FittedModel nominal = fit_nominal(train, pair.sheet, options.fit, study.observer_hz);
  searched_from_sheet(study, nominal);
  EXPECT_EQ(searches, 1);
  const FinishFirst first;
  request_finish();
  EXPECT_EQ(searched_from_sheet(study, nominal).mean_cost, nominal.mean_cost);
  EXPECT_EQ(searches, 1);
}

/// What is under way, too.
TEST(StoppedDiagnosis, CutsShortASearchForTheGap) {
  using namespace internal::diagnosis;
  const blind::BlindPair pair = blind::blind_pair("geared", "motor_coulomb_friction", 0.7, 500002);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  bool is_asked = false;
  DiagnosisOptions options;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  options.progress = [&](const std::string& what) {
    if (is_asked && what.starts_with("looking for the gap again")) request_finish();
  };
  ReferenceModel sheet = pair.sheet;
  sheet.parameters[place::kGap] = ParameterSetting::sought(kNaN);
  const Study study = make_study(train, held_out, sheet, options);
  const FittedModel nominal = fit_nominal(train, pair.sheet, options.fit, study.observer_hz);
  const auto work_of_search = [&] {
    const std::int64_t before = *options.fit.work;
    searched_from_sheet(study, nominal);
    return *options.fit.work - before;
  };
  const std::int64_t whole = work_of_search();
  const FinishFirst first;
  is_asked = true;
  EXPECT_LT(2 * work_of_search(), whole);
  EXPECT_TRUE(finish_requested()) << "while it was under way";
  EXPECT_NO_THROW(stop_point());
}

}  // namespace
}  // namespace gapscope
