#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "blind/blind_pair.h"
#include "diagnosis/among.h"
#include "diagnosis/one_inertia.h"
#include "diagnosis/study.h"
#include "gapscope/base/errors.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/recording/recording.h"
#include "independent_plant/severity.h"
#include "telling/answer.h"

namespace gapscope {
namespace {

Diagnosis diagnosis_of(const blind::BlindPair& pair, const DiagnosisOptions& options = {}) {
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  return diagnose(train, held_out, pair.sheet, options);
}

TEST(Diagnosis, SaysThatItWasNotRun) { EXPECT_EQ(Diagnosis{}.verdict, DiagnosisVerdict::kNotRun); }

TEST(Diagnosis, FindsNothingMissingWhereNothingIs) {
  const Diagnosis d = diagnosis_of(blind::blind_pair("geared", "none", 0.0, 500001));
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kNone);
  EXPECT_TRUE(d.effects.empty());
  EXPECT_LT(d.mismatch.before, 1.3 * d.mismatch.floor);
  EXPECT_TRUE(std::isnan(d.mismatch.shrink));
}

TEST(Diagnosis, BlamesNothingForWhatTheFittedRecordingLeavesOpen) {
  const Diagnosis d = diagnosis_of(blind::blind_pair("geared", "none", 0.0, 400253));
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kNone);
  EXPECT_LT(d.mismatch.before, 1.3 * d.mismatch.floor);
  EXPECT_EQ(d.warnings.size(), 1u);
}

TEST(Diagnosis, SeesACoarserEncoderThanTheSheetSays) {
  const blind::BlindPair pair = blind::blind_pair("paper", "encoder_quantization", 0.7, 500007);
  const Diagnosis d = diagnosis_of(pair, test::among({"encoder_quantization", "shaft_compliance"}));
  ASSERT_EQ(d.effects, std::vector<std::string>{"encoder_quantization"});
  EXPECT_NEAR(d.ranking.front().parameters.front().value, 8.0 * pair.train.quantum,
              1e-3 * pair.train.quantum);
}

TEST(Diagnosis, TakesASteadySpeedForNoCoarserEncoder) {
  const blind::BlindPair pair = blind::blind_pair("paper", "shaft_compliance", 0.336, 420016);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  ASSERT_GT(seen_quantum(held_out[0].x1), 1.5 * held_out[0].quantum);  // its steps alone look like counts
  EXPECT_EQ(internal::diagnosis::make_study(train, held_out, pair.sheet, {}).seen_quantum, 0.0);
}

void expect_named_with_its_blame(const Diagnosis& d) {
  ASSERT_EQ(d.verdict, DiagnosisVerdict::kEffect);
  EXPECT_EQ(d.effects, std::vector<std::string>{"motor_coulomb_friction"});
  EXPECT_EQ(d.group.front(), "motor_coulomb_friction");
  EXPECT_GT(d.mismatch.shrink, 0.9);
  EXPECT_LE(d.mismatch.shrink_ci95.low, d.mismatch.shrink);
  EXPECT_GE(d.mismatch.shrink_ci95.high, d.mismatch.shrink);
  EXPECT_EQ(d.blame.size(), 5u);  // one row for each estimated parameter of the drive
  EXPECT_EQ(d.fitted.effects.size(), 1u);
}

/// run rejects a model without that friction, and tells no gap; the model that has it tells one.
void expect_amount_and_gap_with_intervals(const Diagnosis& d) {
  const NamedValue& level = d.added.front().parameters.front();
  EXPECT_LT(level.ci95.high - level.ci95.low, 0.1 * level.value);
  EXPECT_TRUE(level.ci95.low < level.value && level.value < level.ci95.high);
  const std::optional<Answer> gap = answer_of_diagnosis(d, Coordinates());
  ASSERT_TRUE(gap.has_value());
  EXPECT_EQ(gap->gap, d.fitted.parameters[place::kGap].value);
  EXPECT_LT(gap->ci95.low, gap->gap);
}

void expect_error_spread_over_each_quantity(const Diagnosis& d) {
  for (const auto* map : {&d.where.mode, &d.where.direction, &d.where.speed, &d.where.angle, &d.where.input,
                          &d.where.frequency, &d.where.time}) {
    double share = 0.0, expected = 0.0;
    for (const MapShare& s : *map) share += s.share, expected += s.expected;
    EXPECT_NEAR(share, 1.0, 1e-9);
    EXPECT_NEAR(expected, 1.0, 1e-9);
  }
}

void expect_same_decision_from_evidence_alone(const Diagnosis& d) {
  const StepOutcome again = decide_again(d.evidence);
  ASSERT_EQ(again.ranking.size(), d.ranking.size());
  for (std::size_t i = 0; i < d.ranking.size(); ++i) EXPECT_EQ(again.ranking[i], d.ranking[i].effect);
  EXPECT_TRUE(again.accepted);
  EXPECT_EQ(again.group, d.group);
  EXPECT_DOUBLE_EQ(again.rel, d.ranking.front().rel);
  const StepOutcome without = decide_again(d.evidence, {d.effects.front()});
  EXPECT_NE(without.ranking.front(), d.effects.front());
  EXPECT_LT(without.gain, again.gain);
}

// One test: the diagnosis takes longer than all that is asked of it.
TEST(Diagnosis, OfMotorFrictionNamesItTellsAmountsSpreadsTheErrorAndDecidesAgain) {
  const Diagnosis d = diagnosis_of(blind::blind_pair("geared", "motor_coulomb_friction", 0.7, 500002));
  expect_named_with_its_blame(d);
  if (HasFatalFailure()) return;
  expect_amount_and_gap_with_intervals(d);
  expect_error_spread_over_each_quantity(d);
  expect_same_decision_from_evidence_alone(d);
}

TEST(Diagnosis, BlamesNoNeighbourWhenTheEffectAndItsLookAlikesAreNoCandidates) {
  const DiagnosisOptions options =
      test::among({"friction_asymmetry", "load_dependent_friction", "torque_saturation", "supply_sag"});
  const Diagnosis d = diagnosis_of(blind::blind_pair("geared", "input_dead_zone", 0.7, 500003), options);
  EXPECT_NE(d.verdict, DiagnosisVerdict::kEffect);
  EXPECT_NE(d.verdict, DiagnosisVerdict::kNone);
  for (const RankedEffect& e : d.ranking) EXPECT_FALSE(contains(options.excluded, e.effect)) << e.effect;
}

/// What a first step decides by: a model of 20 floors, and one effect that leaves some of it.
StepEvidence evidence_of(const std::string& effect, double left) {
  StepEvidence e;
  e.nominal = {"", 6.0, 100.0, 20.0, 20.0, kNaN};
  e.candidates = {{effect, 2.0, 1.0, left, left, 1.0}, {"contact_adhesion", 5.9, 90.0, 19.0, 19.0, 0.5}};
  return e;
}

TEST(Diagnosis, AcceptsAFirstStepAloneOnlyWhereItLeavesHardlyAnything) {
  for (const char* const effect : {"shaft_compliance", "presliding_friction"}) {
    EXPECT_TRUE(decide_again(evidence_of(effect, 1.2)).accepted) << effect;
    EXPECT_TRUE(decide_again(evidence_of(effect, 2.8)).accepted) << effect;
    EXPECT_FALSE(decide_again(evidence_of(effect, 3.0)).accepted) << effect;
  }
  StepEvidence real_drive = evidence_of("input_delay", 3.0);
  real_drive.repeats_badly = true;  // no model can reach the floor
  EXPECT_TRUE(decide_again(real_drive).accepted);
}

TEST(Diagnosis, PrefersTheSimplerOfTwoNestedEffectsAtTheFloor) {
  StepEvidence e = evidence_of("friction_asymmetry", 1.0);
  e.candidates[0].score = 0.10;
  e.candidates.push_back({"motor_coulomb_friction", 0.15, 1.0, 1.0, 1.0, 1.0});
  EXPECT_EQ(decide_again(e).ranking.front(), "motor_coulomb_friction");
  EXPECT_EQ(decide_again(e).group, std::vector<std::string>{"motor_coulomb_friction"});
  e.candidates[2].score = 0.35;
  EXPECT_EQ(decide_again(e).ranking.front(), "friction_asymmetry");
}

TEST(Diagnosis, TellsLookAlikesApartByMoreThanOthers) {
  StepEvidence e = evidence_of("input_delay", 1.0);
  e.candidates.push_back({"actuator_lag", 0.0, 1.0, 1.0, 1.0, 1.0});
  e.candidates.push_back({"cogging_torque", 0.0, 1.0, 1.0, 1.0, 1.0});
  e.candidates[0].score = 0.3, e.candidates[2].score = 0.5, e.candidates[3].score = 0.5;
  EXPECT_EQ(decide_again(e).group, (std::vector<std::string>{"input_delay", "actuator_lag"}));
  e.candidates[2].score = 0.7;
  EXPECT_EQ(decide_again(e).group, std::vector<std::string>{"input_delay"});
  e.candidates[3].score = 0.35;
  EXPECT_EQ(decide_again(e).group, (std::vector<std::string>{"input_delay", "cogging_torque"}));
}

TEST(Diagnosis, FitsHalfOfWhatIsHeldOutWhereTheOtherRecordingAsksForTooLittle) {
  const Diagnosis d = diagnosis_of(blind::blind_pair("heavy", "encoder_eccentricity", 0.117, 442492),
                                   test::among({"encoder_eccentricity", "quadratic_drag"}));
  EXPECT_EQ(d.effects, std::vector<std::string>{"encoder_eccentricity"});
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const std::string& w) { return w.find("first half") != std::string::npos; }));
}

TEST(Diagnosis, AcceptsNoRefusedFirstStepForReachingTheFloorAlone) {
  const Diagnosis d = diagnosis_of(blind::blind_pair("heavy", "input_jitter", 0.504, 650033),
                                   test::among({"measurement_lag", "quadratic_drag"}));
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kUnknown);
}

TEST(Diagnosis, ReadsTheSizeAndThePhaseOfAnEccentricityOffTheRecording) {
  independent_plant::BlindCase truth;
  truth.sensor = independent_plant::BlindSensor::with_bits(20);
  give_effect(truth, "encoder_eccentricity", 0.5, 400012);
  const blind::BlindPair pair = blind::blind_pair("paper", "encoder_eccentricity", 0.5, 400012);
  const MotorTrace train[] = {pair.train.motor_trace()};
  const DiagnosisOptions options;
  const internal::diagnosis::Study study = internal::diagnosis::make_study(train, train, pair.sheet, options);
  const internal::diagnosis::FittedModel nominal =
      internal::diagnosis::fit_nominal(train, pair.sheet, {}, 3.0);
  const EffectStart far{0.02, 0.0};
  const internal::diagnosis::FittedModel found =
      internal::diagnosis::RacedCandidate(study, nominal, internal::diagnosis::bases_of(study, nominal),
                                          *find_effect("encoder_eccentricity"), {&far, 1}, nullptr)
          .refined();
  const auto& values = found.model.effects.back().parameters;
  EXPECT_NEAR(values[0].value / truth.drive.effects.sensor.eccentricity_rad, 1.0, 0.02);
  EXPECT_NEAR(std::remainder(values[1].value - truth.drive.effects.sensor.eccentricity_phase_rad, 2.0 * kPi),
              0.0, 0.02);
}

// Few candidates and a short recording: this is what ThreadSanitizer looks at.
TEST(Diagnosis, GivesTheSameAnswerForAnyNumberOfThreads) {
  const blind::BlindPair pair = blind::blind_pair("geared", {"actuator_lag"}, 0.6, 500004, 2.0);
  DiagnosisOptions options = test::among({"actuator_lag", "input_delay", "quadratic_drag"});
  options.fit.starts = options.threads = 1;
  const Diagnosis one = diagnosis_of(pair, options);
  ASSERT_EQ(one.ranking.size(), 3u);
  EXPECT_EQ(one.verdict, DiagnosisVerdict::kEffect);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const Diagnosis other = diagnosis_of(pair, options);
    EXPECT_EQ(other.effects, one.effects);
    EXPECT_EQ(other.mismatch.after, one.mismatch.after);
    ASSERT_EQ(other.ranking.size(), one.ranking.size());
    for (std::size_t i = 0; i < one.ranking.size(); ++i) {
      EXPECT_EQ(other.ranking[i].effect, one.ranking[i].effect);
      EXPECT_EQ(other.ranking[i].score, one.ranking[i].score);
    }
  }
}

TEST(Diagnosis, FitsNothingWhereThereIsNothingToStartFrom) {
  const blind::BlindPair pair = blind::blind_pair("geared", "none", 0.0, 500001);
  const MotorTrace train[] = {pair.train.motor_trace()};
  const DiagnosisOptions options;
  const internal::diagnosis::Study study = internal::diagnosis::make_study(train, train, pair.sheet, options);
  const internal::diagnosis::FittedModel nominal =
      internal::diagnosis::fit_nominal(train, pair.sheet, {}, 3.0);
  const EffectEntry* cogging = find_effect("cogging_torque");
  const internal::diagnosis::FittedModel without_a_line =
      internal::diagnosis::RacedCandidate(study, nominal, internal::diagnosis::bases_of(study, nominal),
                                          *cogging, {}, nullptr)
          .refined();
  EXPECT_EQ(without_a_line.mean_cost, kInfinity);
  const EffectStart start{0.05, 2.0, 0.0};
  EXPECT_EQ(internal::diagnosis::RacedCandidate(study, nominal, {}, *cogging, {&start, 1}, &nominal)
                .refined()
                .mean_cost,
            kInfinity);
}

TEST(Diagnosis, RefusesAnUnknownExclusion) {
  DiagnosisOptions options;
  options.excluded = {"gremlins"};
  EXPECT_THROW(diagnosis_of(blind::blind_pair("geared", "none", 0.0, 500001), options), std::logic_error);
}

TEST(Diagnosis, FindsTwoEffectsOneAfterTheOther) {
  independent_plant::MotorEffects both;
  both.friction.level_nm = 0.03;
  both.cogging = {0.02, 13.7, 0.4, 0.0};
  const Diagnosis d = diagnosis_of(test::one_inertia(both, 500022));
  EXPECT_EQ(d.effects.size(), 2u);
  EXPECT_TRUE(contains(d.effects, "motor_coulomb_friction"));
  EXPECT_TRUE(contains(d.effects, "cogging_torque"));
  EXPECT_GT(d.mismatch.shrink, 0.9);
}

// The load seemed to start elsewhere without friction, and that outweighed all else in what was fitted.
TEST(Diagnosis, FindsASecondEffectWhereTheFirstHasMovedTheLoadsStart) {
  const std::vector<std::string> both{"motor_coulomb_friction", "encoder_eccentricity"};
  const Diagnosis d = diagnosis_of(blind::blind_pair("paper", both, 0.303, 716012), test::among(both));
  EXPECT_EQ(d.effects, both);
}

TEST(Diagnosis, FitsHalfOfWhatIsHeldOutWhereOnlyThatShowsTheSecondEffect) {
  const std::vector<std::string> both{"motor_coulomb_friction", "encoder_eccentricity"};
  const Diagnosis d =
      diagnosis_of(blind::blind_pair("geared", both, 0.536, 717007),
                   test::among({"motor_coulomb_friction", "encoder_eccentricity", "shaft_compliance"}));
  EXPECT_EQ(d.effects, both);
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const std::string& w) { return w.find("first half") != std::string::npos; }));
  for (const MismatchTrace& t : d.traces) EXPECT_GT(t.scored_from, 0u) << "only the other half judges";
}

TEST(TemptingAnswers, ACompliantShaftIsNotCalledADelay) {
  const Diagnosis d = diagnosis_of(blind::blind_pair("geared", "shaft_compliance", 0.8, 500005));
  for (const char* wrong : {"input_delay", "actuator_lag", "measurement_lag"}) {
    EXPECT_FALSE(contains(d.effects, wrong));
    EXPECT_FALSE(contains(d.group, wrong));
  }
}

TEST(TemptingAnswers, CoulombFrictionIsNotCalledBacklash) {
  independent_plant::MotorEffects friction;
  friction.friction.level_nm = 0.03;
  const Diagnosis d = diagnosis_of(test::one_inertia(friction, 500006));
  EXPECT_EQ(d.effects, std::vector<std::string>{"motor_coulomb_friction"});
  EXPECT_FALSE(contains(d.group, "backlash"));
}

TEST(Diagnosis, RefusesWhatStandsStill) {
  blind::BlindPair pair = blind::blind_pair("geared", "none", 0.0, 500001);
  pair.train.x1.assign(pair.train.size(), 5.0);
  const MotorTrace train[] = {pair.train.motor_trace()};
  EXPECT_THROW(diagnose(train, {}, pair.sheet, {}), ConfigError);
}

}  // namespace
}  // namespace gapscope
