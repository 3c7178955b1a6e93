// What the card says of the amounts of what helps.
#include <gmock/gmock.h>

#include "diagnosis/slide_card.h"

namespace gapscope {
namespace {

using ::testing::EndsWith;
using testing::facts_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::slide_diagnosis;

TEST(Card, TellsTheAmountOfWhatHelps) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters = {{"level_nm", "N m", 20.54}};
  d.added[1].parameters = {{"share", "-", 0.2}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              StartsWith("The missing force falls from 10 N to 4 N with motor Coulomb friction (20.5 N), "
                         "then to 2 N with cogging torque ("));
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps, Not(HasSubstr("simulated motion")));
  d.mismatch.before = 1.28e-3, d.mismatch.after = 1.42e-3,
  d.mismatch.measure = "free run restarted every 2 s";
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).helps,
      HasSubstr("; but the simulated motion comes no nearer, 1.28 mm off before and 1.42 mm after (free "
                "run restarted every 2 s)"));
  d.added[1].effect = "friction_asymmetry", d.added[1].parameters = {{"level_nm", "N m", 20.54}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              HasSubstr("motor Coulomb friction (20.5 N), then to 2 N with friction asymmetry; in all"))
      << "both share one amount";
}

// In a model with two effects that contain friction each has a part of its level.
TEST(Card, TellsTheWholeLevelOfFrictionThatTwoEffectsShareAndARatioOfAllOfIt) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters.clear();
  d.added[1].effect = "friction_asymmetry";
  d.added[1].parameters = {{"level_nm", "N m", 15.0}, {"coulomb_ratio", "-", 0.2, {0.1, 0.3}}};
  d.added.push_back(d.added[1]);
  d.added[2].effect = "stribeck_friction";
  d.added[2].parameters = {{"level_nm", "N m", 5.0, {4.0, 6.0}}, {"stiction_ratio", "-", -0.8, {-0.9, -0.7}}};
  const std::string helps = card_of(facts_of(nullptr, &d)).helps;
  EXPECT_THAT(helps, HasSubstr("motor Coulomb friction (20 N)"));
  EXPECT_THAT(helps, HasSubstr("(+15.0 % of the mean friction forward"));
  EXPECT_THAT(helps, HasSubstr("(-20.0 % of the Coulomb friction, at standstill, 95 %: -22.5 to -17.5)"));
}

TEST(Card, TellsWhereASteadyTorquePushes) {
  Diagnosis d = slide_diagnosis();
  d.added[1].effect = "constant_load_torque";
  d.added[1].parameters = {{"torque_nm", "N m", -2.2726, {-2.2807, -2.2644}}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              HasSubstr("constant load torque (2.2726 N pushing backward, 95 %: 2.2644 to 2.2807)"));
  d.added[1].parameters = {{"torque_nm", "N m", 2.2726}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps, HasSubstr("(2.27 N pushing forward"));
}

TEST(Card, TellsAnAmountWithoutAUnitAsAShareAndALawByWhatItAddsToASimplerOne) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters = {{"level_nm", "N m", 20.54}};
  d.added[1].effect = "torque_ripple", d.added[1].parameters = {{"ratio", "-", 0.0312, {0.0305, 0.0319}}};
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).helps,
      HasSubstr("(20.5 N), then to 2 N with torque ripple (3.120 % of the motor's torque (amplitude), 95 %: "
                "3.050 to 3.190); in all"));
  d.added[1].effect = "load_dependent_friction";
  d.added[1].parameters = {{"level_nm", "N m", 20.54}, {"ratio", "-", 0.1, {0.09, 0.11}}};
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).helps,
      HasSubstr("with motor Coulomb friction (20.5 N), then to 2 N with load-dependent friction (10.0 % of "
                "the torque that goes to the load, "
                "95 %: 9.0 to 11.0); in all"));
}

TEST(Card, OfALawWithSeveralRatiosTellsTheLargest) {
  Diagnosis d = slide_diagnosis();
  d.added[1].effect = "friction_asymmetry";
  d.added[1].parameters = {{"level_nm", "N m", 20.54},
                           {"coulomb_ratio", "-", -0.0052},
                           {"viscous_ratio", "-", -0.2, {-0.22, -0.18}}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              HasSubstr("then to 2 N with friction asymmetry (-20.0 % of the mean damping forward, with "
                        "the opposite sign backward, 95 %: -22.0 to -18.0); in all"));
}

TEST(Card, OfOneEffectTellsTheAmountAndOfSeveralTheShares) {
  Diagnosis d = slide_diagnosis();
  d.added.erase(d.added.begin());
  d.added.front().established = true;
  d.added.front().parameters = {{"amplitude_nm", "N m", 2.054}, {"periods_per_turn", "1/rev", 2513.3}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              StartsWith("Cogging torque (every 2.5 mm; amplitude 2.05 N) brings the missing force down from "
                         "10 to 2 N (20.0 % to "
                         "4.0 % of what the input applies)"));
  d.added.front().parameters.clear();
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              StartsWith("Cogging torque brings the missing force down from 10 to 2 N"));
  d = slide_diagnosis();
  d.added[0].after_torque = kNaN, d.added[0].parameters = {{"level_nm", "N m", 20.54}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              StartsWith("Motor Coulomb friction (20.5 N; cuts the free-run error by 60 %) and cogging "
                         "torque (cuts what is left of the free-run error by 50 %) bring the missing force "
                         "down from 10"));
}

/// Between the lines of a budget there may be laws that the model cannot have, and effects beside them.
TEST(Card, TellsTheTorqueOfTheModelThatFittedYamlHas) {
  Diagnosis d = slide_diagnosis();
  d.budget.band_hz = 8.0;
  d.mismatch.after_torque = 3.0;  // the last line, 2.0, has a law beside both that nobody can add
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).helps,
      StartsWith("Motor Coulomb friction (cuts the free-run error by 60 %) and cogging torque "
                 "(cuts what is left of the free-run error by 50 %) bring the missing force down from 10 "
                 "to 3 N (20.0 % to 6.0 % of what the input applies)"));
  const std::string counted = card_of(facts_of(nullptr, &d)).helps;
  d.budget.uncounted = {"cogging_torque"};  // then the observer has measured both sizes
  EXPECT_EQ(card_of(facts_of(nullptr, &d)).helps, counted);
}

TEST(Card, TellsAnAmountWithItsInterval) {
  Diagnosis d = slide_diagnosis();
  d.added[0].parameters = {{"level_nm", "N m", 20.54, {20.1, 20.98}}};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              HasSubstr("4 N with motor Coulomb friction (20.54 N, 95 %: 20.10 to 20.98), then"));
  d.added.pop_back();
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).helps,
      StartsWith("Motor Coulomb friction (20.54 N, 95 %: 20.10 to 20.98) brings the missing force down"));
}

TEST(Card, OfManyEffectsTellsWhatEachLeaves) {
  Diagnosis d = slide_diagnosis();
  d.added.resize(1);
  for (const char* more : {"cogging_torque", "viscous_friction", "torque_ripple", "load_friction"})
    d.added.push_back({more, true, {more}, kNaN, {}, 0.1, {}, 4.0 - 0.5 * double(d.added.size())});
  Card card = card_of(facts_of(nullptr, &d));
  EXPECT_THAT(
      card.helps,
      StartsWith(
          "The missing force falls from 10 N to 4 N with motor Coulomb friction, then to 3.5 N with cogging "
          "torque, then to 3 N with viscous friction, then to 2.5 N with torque ripple, then to 2 N "
          "with load friction; in all"));
  EXPECT_EQ(card.cause,
            "Established: motor Coulomb friction, cogging torque, viscous friction, torque ripple and load "
            "friction.");
}

TEST(Card, TellsLinesOfOneEffectApartByTheirPeriods) {
  Diagnosis d = slide_diagnosis();
  d.effects = {"cogging_torque", "cogging_torque"};
  for (AddedEffect& a : d.added)
    a.effect = "cogging_torque", a.established = true, a.group = {"cogging_torque"};
  d.added[0].parameters = {{"amplitude_nm", "N m", 5.0}, {"periods_per_turn", "1/rev", 2.0 * kPi / 2.5e-3}};
  d.added[1].parameters = {{"amplitude_nm", "N m", 1.0}, {"periods_per_turn", "1/rev", 2.0 * kPi / 0.01}};
  CardFacts f = facts_of(nullptr, &d);
  EXPECT_EQ(card_of(f).cause, "Established: cogging torque every 2.5 mm and cogging torque every 10 mm.");
  EXPECT_THAT(card_of(f).helps, StartsWith("The missing force falls from 10 N to 4 N with cogging torque "
                                           "every 2.5 mm (amplitude 5 N), then to 2 N with cogging "
                                           "torque every 10 mm (amplitude 1 N); in all"));
  f.coordinates = Coordinates::kRotation;
  d.added[0].parameters[1].value = 24.0, d.added[1].parameters[1].value = 7.25;
  EXPECT_EQ(card_of(f).cause,
            "Established: cogging torque at 24 cycles per turn of x1 and cogging torque at 7.25 "
            "cycles per turn of x1.");
}

TEST(CardNext, NamesAFormatThatHasAllThatWasAddedOrSaysThatNoneHas) {
  Diagnosis d = slide_diagnosis();
  for (AddedEffect& a : d.added) a.established = true;
  CardFacts f = facts_of(nullptr, &d);
  EXPECT_THAT(card_of(f).next, HasSubstr("`gapscope export` takes it to other simulators."));
  f.carriers = {"c"};
  EXPECT_THAT(card_of(f).next,
              HasSubstr("`gapscope export DIR --to c -o DIR_c` takes it to other simulators."));
  d.closed_loop = ClosedLoop{0.4, 0.05, {}};
  EXPECT_THAT(card_of(f).next, HasSubstr("`gapscope export DIR --to c -o DIR_c` takes the drive, without its "
                                         "controller, to other simulators."));
  d.closed_loop.reset();
  f.carriers = std::vector<std::string>(), f.uncarried = {"load_dependent_friction"};
  EXPECT_THAT(
      card_of(f).next,
      HasSubstr("`gapscope export` loses a part of load-dependent friction in every format, and says in "
                "certificate.md how much."));
  EXPECT_THAT(card_of(f).next, Not(HasSubstr("takes it to other simulators")));
}

}  // namespace
}  // namespace gapscope
