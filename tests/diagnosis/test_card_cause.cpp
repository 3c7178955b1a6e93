// What the card says of the cause.
#include <gmock/gmock.h>

#include "diagnosis/friction_and_delay.h"
#include "gapscope/diagnosis/simulator.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(CardCause, ALaterOneIsEstablishedWithAnOpenFirstOneInTheModel) {
  EXPECT_EQ(card_of(of_friction_and_delay(false, true)).cause,
            "Not established, though it helps: motor Coulomb friction (it may as well be quadratic drag). "
            "Established with it in the model: input delay.");
}

TEST(CardCause, OneOfAGroupIsNotCalledEstablished) {
  Diagnosis d = of_friction_and_delay(true, true);
  EXPECT_EQ(
      card_of(d).cause,
      "Established: input delay. Either motor Coulomb friction or quadratic drag is missing, too (these "
      "recordings cannot tell which; `fitted.yaml` has motor Coulomb friction).");
  d.added[0].group.push_back("load_friction");
  EXPECT_THAT(
      card_of(d).cause,
      HasSubstr(". One of motor Coulomb friction, quadratic drag and load friction is missing, too (these"));
  d.added[0].group.resize(1);
  EXPECT_EQ(card_of(d).cause, "Established: motor Coulomb friction and input delay.");
  d.added[1].established = false;
  EXPECT_EQ(card_of(d).cause,
            "Established: motor Coulomb friction. Not established, though it helps: input delay.");
}

TEST(CardCause, OfOneLawUnderTwoNamesSaysThatNoRecordingTells) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.added[0].effect = "constant_load_torque";
  d.added[0].group = {"constant_load_torque", "friction_asymmetry"};
  EXPECT_THAT(card_of(d).cause,
              HasSubstr("friction asymmetry is missing, too (these recordings cannot tell which;"))
      << "a gap tells them apart";
  d.model_gap = ModelGap();
  EXPECT_THAT(card_of(d).cause,
              HasSubstr("Either constant load torque or friction asymmetry is missing, too (no recording can "
                        "tell which: dry friction that differs with the direction is the same as"));
}

TEST(CardCause, TellsThatTheRecordingsLeaveAnAmountOpen) {
  Diagnosis d = of_friction_and_delay(false, false);
  d.added[0].parameters = {{"level_nm", "N m", 274.0}};
  d.added[0].at_bound = {"level_nm"};
  d.added[1].parameters = {{"delay_s", "s", 0.003, {0.002, 0.004}}};
  EXPECT_EQ(card_of(d).cause,
            "Not established, though they help: motor Coulomb friction (it may as well be quadratic "
            "drag) and input delay.");
  EXPECT_THAT(card_of(d).helps, HasSubstr("motor Coulomb friction (274 N·m, at the bound of its search)"));
  d.added[0].group.pop_back(), d.added[0].at_bound.clear(), d.added.pop_back();
  EXPECT_EQ(card_of(d).cause,
            "Not established, though it helps: motor Coulomb friction (these recordings do not determine its "
            "amount).");
  EXPECT_THAT(card_of(d).helps,
              HasSubstr("friction (274 N·m, an amount that the recordings do not determine)"));
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
  EXPECT_EQ(
      card.cause,
      "No effect is missing that this recording could show; only numbers of the configuration were off, and "
      "are fitted now.");
  EXPECT_EQ(
      card.helps,
      "Other numbers than the configuration starts at, and nothing more: motor damping 0.1 → "
      "0.04000 N·m s/rad (95 %: 0.03970 to 0.04030), motor inertia 0.00532 → 0.007810 kg m² (95 %: 0.007790 "
      "to 0.007830) and load unbalance amplitude 0.353 → 0.3770 N·m (95 %: 0.3758 to 0.3782); `fitted.yaml` "
      "has "
      "them and is as good as the recording.")
      << "the phase reads the same";
  EXPECT_THAT(card.next, HasSubstr("Simulate with the numbers of `DIR/fitted.yaml`"));
  d.refitted.insert(d.refitted.begin(), {"gap", "rad", 0.02, 0.03, {0.029, 0.031}});
  EXPECT_THAT(card_of(d).helps,
              HasSubstr("0.007830), and smaller changes in load unbalance amplitude; `fitted.yaml`"));
  d.refitted[3].fitted = 0.44;
  EXPECT_THAT(card_of(d).helps, HasSubstr("nothing more: load unbalance amplitude 0.353 → 0.4400 N·m (95 %"))
      << "a torque of an effect that changes by more than a tenth";
  d.refitted[3].fitted = 0.377,
  d.refitted.push_back({"contact_stiffness", "N m/rad", 100.0, 120.0, {119.0, 121.0}});
  EXPECT_THAT(
      card_of(d).helps,
      HasSubstr("contact stiffness 100 → 120.0 N·m/rad (95 %: 119.0 to 121.0), and smaller changes in load "
                "unbalance amplitude; `fitted.yaml`"))
      << "no change of more than a tenth is hidden";
  d.refitted = {of_other_numbers().refitted.back()};
  EXPECT_EQ(card_of(d).helps, "Nothing needed: the model is as good as the recording.");
  EXPECT_EQ(card_of(d).next, "None.");
}

TEST(CardCause, OfAnotherVerdictTellsTheNumbersBrieflyBehindTheNextStep) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.refitted = of_other_numbers().refitted;
  EXPECT_THAT(
      card_of(d).next,
      HasSubstr(
          " Of your own numbers the fit has changed motor damping 0.1 → 0.04000 N·m s/rad (95 %: 0.03970 to "
          "0.04030), motor inertia 0.00532 → "
          "0.007810 kg m² (95 %: 0.007790 to 0.007830), and smaller changes in load unbalance amplitude."));
  d.model_gap = ModelGap();
  EXPECT_THAT(card_of(d).next, HasSubstr(", motor inertia (of all that moves) 0.00532 → "));
  d.refitted = {{"mass_ratio", "-", 1.2, 1.0, {0.99, 1.01}}};
  EXPECT_THAT(card_of(d).next, HasSubstr("has changed mass ratio (load over motor) 1.2 → 1.000 (95 %"));
  EXPECT_THAT(card_of(d).mismatch, StartsWith("With nothing added, the refitted model misses "));
  d.refitted.clear();
  EXPECT_THAT(card_of(d).next, Not(HasSubstr("changed")));
  EXPECT_THAT(card_of(d).mismatch, StartsWith("With nothing added, the model misses "));
}

// The input's scale, inertia and damping are one number too many: recordings alone know their ratios.
TEST(CardCause, WhereInertiaAndDampingGrowAlikeTheTorqueConstantMayBeWrong) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.refitted = {{"motor_inertia", "kg m^2", 0.0635, 0.07215, {0.07210, 0.07220}},
                {"motor_damping", "N m s/rad", 0.3, 0.341, {0.3405, 0.3415}}};
  EXPECT_THAT(
      card_of(d).next,
      HasSubstr(
          " Inertia and damping are both 1.136 times those of the configuration, which the recordings "
          "cannot tell from a torque constant (or gear ratio) that is 12 % smaller: where the inertia is "
          "certain, give it as a bare number, which is held, and set torque_constant: {estimate: true}."));
  d.refitted[1].ci95 = {0.345, 0.347};
  EXPECT_THAT(card_of(d).next, Not(HasSubstr("torque constant"))) << "they grow by different factors";
  d.refitted[1].ci95 = {0.33, 0.352};
  EXPECT_THAT(card_of(d).next, Not(HasSubstr("torque constant"))) << "the damping is known to 3 % alone";
  d = of_other_numbers();
  d.refitted[1].configured = 0.01953, d.refitted[1].fitted = 0.00781;
  EXPECT_THAT(card_of(d).helps, HasSubstr("a torque constant (or gear ratio) that is 150 % larger"));
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
  EXPECT_EQ(
      card.helps,
      "Nothing need be added to the model, which is as good as the recording. Your simulator's error, "
      "268.8 mrad, falls to 125.7 mrad with motor damping mended and to 0.1149 mrad with all 2 rows that "
      "differ.");
  EXPECT_EQ(
      card.next,
      "Mend your simulator: motor damping and motor inertia, as the table of drive and simulator has it; "
      "`fitted.yaml` has the drive's numbers.");
  c.rows.front().differs = c.rows.back().differs = false;
  EXPECT_EQ(gapscope::card_of(f).next, "None.");
}

TEST(CardCause, SaysWhyTheBalanceDoesNotEstablish) {
  Diagnosis d = of_friction_and_delay(true, false);
  d.added[0].group = {"motor_coulomb_friction"},
  d.added[1].parameters = {{"delay_s", "s", 0.003, {2e-3, 4e-3}}};
  d.budget.rungs = {{"input_delay", "input_delay", true, 0.04, 0.037, 0.14, {0.11, 0.2}, 0.2, 0.3}};
  BudgetRung& rung = d.budget.rungs.front();
  const auto cause = [&] { return card_of(d).cause; };
  EXPECT_THAT(cause(),
              HasSubstr("helps: input delay (it lowers the error by only 7.3 %). Only what lowers it by "
                        "10.6 % or more (20 % of its mean square) is called a cause."))
      << "0.14 and 0.2 of the mean square";
  rung.share = 0.4, rung.share_ci95 = {0.05, 0.5};
  EXPECT_THAT(cause(), HasSubstr("input delay (by how much it lowers the error is uncertain, 3 to 29 %)."));
  rung.share_ci95 = {0.3, 0.5};
  EXPECT_THAT(cause(), HasSubstr("input delay (another torque would remove nearly as much in its place)."));
  rung.rivals = {"torque_ripple"};
  EXPECT_THAT(cause(), HasSubstr("input delay (torque ripple would remove nearly as much in its place)."));
  rung.rivals = {"free_speed_curve"};
  EXPECT_THAT(cause(),
              HasSubstr("delay (a free curve over the speed would remove nearly as much in its place)."));
  rung.last = 0.1;
  EXPECT_THAT(cause(), HasSubstr("input delay (what was added after it removes most of the same)."));
  rung.share = 0.14, d.added[0].established = false;
  d.budget.rungs.push_back(
      {"motor_coulomb_friction", "motor_coulomb_friction", true, 0.1, 0.09, 0.1, {}, 0.1, 0.3});
  EXPECT_THAT(
      cause(),
      HasSubstr("friction (it lowers the error by only 5.1 %) and input delay (it lowers the error by only "
                "7.3 %). Only what lowers it by 10.6 % or more (20 % "
                "of its mean square) is called a cause."));
}

TEST(CardCause, TellsThatTheSearchEndedAtItsLimit) {
  Diagnosis d = of_friction_and_delay(true, true);
  d.mismatch.remains = 10.0;
  EXPECT_THAT(card_of(d).cause, Not(HasSubstr("limit of work")));
  d.exhausted = true;
  EXPECT_THAT(card_of(d).cause, HasSubstr(" The search ended at its limit of work, so that further causes "
                                          "may have been missed."));
  EXPECT_EQ(
      card_of(d).next,
      "Go on from what was found: `gapscope diagnose CONFIG --model-from DIR/fitted.yaml -o DIR_more`.");
  d.mismatch.remains = 1.1;
  EXPECT_THAT(card_of(d).cause, Not(HasSubstr("limit of work"))) << "nothing is left to be found";
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
  EXPECT_EQ(card_of(d).cause,
            "Unknown, though load unbalance is suspected: as a term of the torque balance it brings the "
            "missing torque down from 12.6 to 2.43 N·m, but no simulation with it follows the recordings "
            "well enough to establish it.");
  EXPECT_EQ(card_of(d).helps, "Nothing that these recordings establish; `fitted.yaml` has no addition.");
  EXPECT_THAT(card_of(d).next, HasSubstr("Record the drive in another motion"))
      << "swapped they would send back: what is fitted asks as much";
  d.better_swapped = true;
  EXPECT_EQ(
      card_of(d).cause,
      "Unknown, though load unbalance is suspected: as a term of the torque balance it brings the missing "
      "torque "
      "down from 12.6 to 2.43 N·m, but the recording that was fitted moves too little to establish a cause.");
  d.next_experiment.sentence = "Record a sine.";
  EXPECT_THAT(card_of(d).next, HasSubstr("Swap `file` and `held_out`")) << "takes no new one";
  d.next_experiment = {};
  EXPECT_THAT(card_of(d).mismatch,
              HasSubstr("12.6 N·m rms of torque on held-out data, 10 times the 1.24 N·m rms"));
  d.budget.rungs.front().share = 0.3, d.better_swapped = false;
  EXPECT_EQ(card_of(d).cause, "Unknown, as no effect of the catalogue explains it.");
  EXPECT_THAT(card_of(d).next, HasSubstr("Record the drive in another motion"));
  d.mismatch.input_torque = 3e3;
  EXPECT_EQ(
      card_of(d).next,
      "None, if 0.42 % of the torque is little enough (`tolerance: {torque_percent: 1}` judges it). Else "
      "record the drive in another motion (other speeds, other loads) and diagnose that.");
  d.next_experiment.sentence = "No input within the limits would tell a from b by one σ.";
  d.next_experiment.tried.resize(1);
  EXPECT_THAT(card_of(d).next, HasSubstr("None, if 0.42 %")) << "neither was named";
}

TEST(CardCause, OfUnknownNamesTheLikeliestThatWasNotTakenAndAnErrorNearTheFloor) {
  Diagnosis d = unknown_beside_a_budget();
  d.budget = {};
  d.mismatch.floor_from = FloorSource::kEncoder, d.mismatch.remains = 1.47;
  EXPECT_EQ(
      card_of(d).cause,
      "Unknown, as no effect of the catalogue explains it; it is little, as the error in x1 is 1.5 times "
      "what the encoder can show.");
  d.mismatch.remains = 9.0;
  EXPECT_EQ(card_of(d).cause, "Unknown, as no effect of the catalogue explains it.");
  RankedEffect likeliest;
  likeliest.effect = "cogging_torque", likeliest.probability = 0.54, likeliest.shrink = 0.221;
  d.ranking = {likeliest}, d.outside_probability = 0.4;
  EXPECT_EQ(
      card_of(d).cause,
      "Unknown, as no effect of the catalogue explains it well enough: cogging torque is the likeliest, "
      "but removes 22 % of the error above the floor.");
  d.outside_probability = 0.6;
  EXPECT_EQ(card_of(d).cause, "Unknown, as no effect of the catalogue explains it.");
}

TEST(CardCause, OfAnInputThatTheControllerMakesSaysWhatWouldEstablishIt) {
  Diagnosis d = unknown_beside_a_budget();
  d.traces.resize(1);
  d.traces.front().target = {0.0, 0.1};
  EXPECT_THAT(
      card_of(d).cause,
      HasSubstr("to establish it. The torque here was not recorded but computed from the goal by the model's "
                "controller, which hides a part of what is missing."));
  EXPECT_THAT(card_of(d).next,
              ::testing::StartsWith("Record the motor's input as well (duty, current or torque)"));
}

}  // namespace
}  // namespace gapscope
