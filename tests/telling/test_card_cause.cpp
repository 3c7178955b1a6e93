// What the card says of the cause.
#include <gmock/gmock.h>

#include "diagnosis/friction_and_delay.h"
#include "diagnosis/simulator.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(CardCause, ALaterOneIsEstablishedWithAnOpenFirstOneInTheModel) {
  EXPECT_TOLD(card_of(of_friction_and_delay(false, true)).cause);
}

TEST(CardCause, OneOfAGroupIsNotCalledEstablished) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_TOLD(card_of(d).cause);
  d.added[0].group.push_back("load_friction");
  EXPECT_TOLD(card_of(d).cause);
  d.added[0].group.resize(1);
  EXPECT_TOLD(card_of(d).cause);
  d.added[1].established = false;
  EXPECT_TOLD(card_of(d).cause);
}

TEST(CardCause, OfOneLawUnderTwoNamesSaysThatNoRecordingTells) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.added[0].effect = "constant_load_torque";
  d.added[0].group = {"constant_load_torque", "friction_asymmetry"};
  EXPECT_TOLD(card_of(d).cause) << "a gap tells them apart";
  d.model_gap = ModelGap();
  EXPECT_TOLD(card_of(d).cause);
}

TEST(CardCause, TellsThatTheRecordingsLeaveAnAmountOpen) {
  Diagnosis d = of_friction_and_delay(false, false);
  d.added[0].parameters = {{"level_nm", "N m", 274.0}};
  d.added[0].at_bound = {"level_nm"};
  d.added[1].parameters = {{"delay_s", "s", 0.003, {0.002, 0.004}}};
  EXPECT_TOLD(card_of(d).cause);
  EXPECT_TOLD(card_of(d).helps);
  d.added[0].group.pop_back(), d.added[0].at_bound.clear(), d.added.pop_back();
  EXPECT_TOLD(card_of(d).cause);
  EXPECT_TOLD(card_of(d).helps);
}

/// A model of 100 N m that its recordings cannot tell from the drive once its damping is 0.04 for 0.1.
Diagnosis of_other_numbers() {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kNone;
  d.mismatch.before = 1e-4, d.mismatch.after = 1e-4, d.mismatch.floor = 1.2e-4;
  d.refitted = {{"motor_damping", "N m s/rad", 0.1, 0.04, {0.0397, 0.0403}},
                {"motor_inertia", "kg m^2", 0.00532, 0.00781, {0.00779, 0.00783}},
                {"load_unbalance.amplitude_nm", "N m", 0.353, 0.377, {0.3758, 0.3782}},
                {"load_unbalance.phase_rad", "rad", 0.5236, 0.5237, {0.52365, 0.52375}}};
  return d;
}

TEST(CardCause, WhereNoEffectIsMissingTellsNumbersOfTheConfigurationThatAreNotTheDrives) {
  Diagnosis d = of_other_numbers();
  const Card card = card_of(d);
  EXPECT_TOLD(card.cause);
  EXPECT_TOLD(card.helps) << "the phase reads the same";
  EXPECT_TOLD(card.next);
  d.refitted.insert(d.refitted.begin(), {"gap", "rad", 0.02, 0.03, {0.029, 0.031}});
  EXPECT_TOLD(card_of(d).helps);
  d.refitted[3].fitted = 0.44;
  EXPECT_TOLD(card_of(d).helps) << "a torque of an effect that changes by more than a tenth";
  d.refitted[3].fitted = 0.377,
  d.refitted.push_back({"contact_stiffness", "N m/rad", 100.0, 120.0, {119.0, 121.0}});
  EXPECT_TOLD(card_of(d).helps) << "no change of more than a tenth is hidden";
  d.refitted = {of_other_numbers().refitted.back()};
  EXPECT_TOLD(card_of(d).helps);
  EXPECT_EQ(card_of(d).codes.next.front(), "next.nothing");
}

TEST(CardCause, OfAnotherVerdictTellsTheNumbersBrieflyBehindTheNextStep) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.refitted = of_other_numbers().refitted;
  EXPECT_TOLD(card_of(d).next);
  d.model_gap = ModelGap();
  EXPECT_TOLD(card_of(d).next);
  d.refitted = {{"mass_ratio", "-", 1.2, 1.0, {0.99, 1.01}}};
  EXPECT_TOLD(card_of(d).next);
  EXPECT_TOLD(card_of(d).mismatch);
  d.refitted.clear();
  EXPECT_TOLD(card_of(d).next);
  EXPECT_TOLD(card_of(d).mismatch);
}

// The input's scale, inertia and damping are one number too many: recordings alone know their ratios.
TEST(CardCause, WhereInertiaAndDampingGrowAlikeTheTorqueConstantMayBeWrong) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.refitted = {{"motor_inertia", "kg m^2", 0.0635, 0.07215, {0.07210, 0.07220}},
                {"motor_damping", "N m s/rad", 0.3, 0.341, {0.3405, 0.3415}}};
  EXPECT_TOLD(card_of(d).next);
  d.refitted[1].ci95 = {0.345, 0.347};
  EXPECT_TOLD(card_of(d).next) << "they grow by different factors";
  d.refitted[1].ci95 = {0.33, 0.352};
  EXPECT_TOLD(card_of(d).next) << "the damping is known to 3 % alone";
  d = of_other_numbers();
  d.refitted[1].configured = 0.01953, d.refitted[1].fitted = 0.00781;
  EXPECT_TOLD(card_of(d).helps);
}

TEST(CardCause, WhereOnlyTheSimulatorDiffersHelpsAndNextAgreeWithItsLine) {
  Diagnosis d = of_other_numbers();
  d.refitted.clear();
  SimulatorComparison c;
  for (const char* name : {"motor_damping", "motor_inertia"}) {
    SimulatorRow& row = c.rows.emplace_back();
    row.name = name, row.differs = true, row.sentence = "its motor damping is 100 where the drive's is 40";
  }
  c.errors.stand_in = 0.2688, c.errors.mended = 0.1257, c.errors.all_mended = 1.149e-4, c.shrink = 0.53;
  CardFacts f;
  f.diagnosis = &d, f.simulated = &c;
  const Card card = gapscope::card_of(f);
  EXPECT_TOLD(card.helps);
  EXPECT_TOLD(card.next);
  c.rows.front().differs = c.rows.back().differs = false;
  EXPECT_EQ(gapscope::card_of(f).codes.next.front(), "next.nothing");
}

TEST(CardCause, SaysWhyTheBalanceDoesNotEstablish) {
  Diagnosis d = of_friction_and_delay(true, false);
  d.added[0].group = {"motor_coulomb_friction"},
  d.added[1].parameters = {{"delay_s", "s", 0.003, {2e-3, 4e-3}}};
  d.budget.rungs = {{"input_delay", "input_delay", true, 0.04, 0.037, 0.14, {0.11, 0.2}, 0.2, 0.3}};
  BudgetRung& rung = d.budget.rungs.front();
  const auto cause = [&] { return card_of(d).cause; };
  EXPECT_TOLD(cause()) << "0.14 and 0.2 of the mean square";
  rung.share = 0.4, rung.share_ci95 = {0.05, 0.5};
  EXPECT_TOLD(cause());
  rung.share_ci95 = {0.3, 0.5};
  EXPECT_TOLD(cause());
  rung.rivals = {"torque_ripple"};
  EXPECT_TOLD(cause());
  rung.rivals = {"free_speed_curve"};
  EXPECT_TOLD(cause());
  rung.last = 0.1;
  EXPECT_TOLD(cause());
  rung.share = 0.14, d.added[0].established = false;
  d.budget.rungs.push_back(
      {"motor_coulomb_friction", "motor_coulomb_friction", true, 0.1, 0.09, 0.1, {}, 0.1, 0.3});
  EXPECT_TOLD(cause());
}

TEST(CardCause, TellsThatTheSearchEndedAtItsLimit) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.remains = 10.0;
  EXPECT_TOLD(card_of(d).cause);
  d.exhausted = true;
  EXPECT_TOLD(card_of(d).cause);
  EXPECT_TOLD(card_of(d).next);
  d.mismatch.remains = 1.1;
  EXPECT_TOLD(card_of(d).cause) << "nothing is left to be found";
}

/// 12.6 N m of 1.24, of which an unbalance takes nearly all in the error budget and is not established.
Diagnosis unknown_beside_a_budget() {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kUnknown;
  d.mismatch.before_torque = d.mismatch.after_torque = 12.6, d.mismatch.input_torque = 1.24;
  d.budget.band_hz = 8.0;
  d.budget.rungs = {{"load_unbalance", "load_unbalance", false, 12.6, 2.43, 0.963, {0.9, 0.98}, 0.9, 0.9}};
  return d;
}

TEST(CardCause, OfUnknownTellsWhatTheBudgetHasAndWhyItIsNotEstablished) {
  Diagnosis d = unknown_beside_a_budget();
  EXPECT_TOLD(card_of(d).cause);
  EXPECT_TOLD(card_of(d).helps);
  EXPECT_TOLD(card_of(d).next) << "swapped they would send back: what is fitted asks as much";
  d.better_swapped = true;
  EXPECT_TOLD(card_of(d).cause);
  d.next_experiment.sentence = "Record a sine.";
  EXPECT_TOLD(card_of(d).next) << "takes no new one";
  d.next_experiment = {};
  EXPECT_TOLD(card_of(d).mismatch);
  d.budget.rungs.front().share = 0.3, d.better_swapped = false;
  EXPECT_TOLD(card_of(d).cause);
  EXPECT_TOLD(card_of(d).next);
  d.mismatch.input_torque = 3e3;
  EXPECT_TOLD(card_of(d).next);
  d.next_experiment.sentence = "No input within the limits would tell a from b by one σ.";
  d.next_experiment.tried.resize(1);
  EXPECT_TOLD(card_of(d).next) << "neither was named";
}

TEST(CardCause, OfUnknownNamesTheLikeliestThatWasNotTakenAndAnErrorNearTheFloor) {
  Diagnosis d = unknown_beside_a_budget();
  d.budget = {};
  d.mismatch.floor_from = FloorSource::kEncoder, d.mismatch.remains = 1.47;
  EXPECT_TOLD(card_of(d).cause);
  d.mismatch.remains = 9.0;
  EXPECT_TOLD(card_of(d).cause);
  RankedEffect likeliest;
  likeliest.effect = "cogging_torque", likeliest.probability = 0.54, likeliest.shrink = 0.221;
  d.ranking = {likeliest}, d.outside_probability = 0.4;
  EXPECT_TOLD(card_of(d).cause);
  d.outside_probability = 0.6;
  EXPECT_TOLD(card_of(d).cause);
}

TEST(CardCause, OfAnInputThatTheControllerMakesSaysWhatWouldEstablishIt) {
  Diagnosis d = unknown_beside_a_budget();
  d.traces.resize(1);
  d.traces.front().target = {0.0, 0.1};
  EXPECT_TOLD(card_of(d).cause);
  EXPECT_TOLD(card_of(d).next);
}

/// The commonest thing that a configuration leaves out: a friction that it holds at 0.
TEST(CardNext, SendFirstToWhatTheConfigurationHolds) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kUnknown, d.better_swapped = true;
  d.held = {"load_damping", "load_coulomb_friction"};
  CardFacts f;
  f.diagnosis = &d;
  EXPECT_THAT(gapscope::card_of(f).codes.next, ::testing::ElementsAre("next.estimate"));
  d.verdict = DiagnosisVerdict::kEffect;
  d.added = {{"input_delay", true, {"input_delay"}, kNaN, {}, 0.5, {}, 0.02}};
  EXPECT_THAT(gapscope::card_of(f).codes.next, ::testing::Not(::testing::Contains("next.estimate")))
      << "its cause is established";
}

}  // namespace
}  // namespace gapscope
