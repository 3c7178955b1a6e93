// What the figures of a card are of: which evidence has decided, in which band, of which model.
#include <gmock/gmock.h>

#include "diagnosis/card_words.h"
#include "diagnosis/slide_card.h"
#include "diagnosis/where.h"
#include "diagnosis/words.h"
#include "gapscope/base/decimals.h"
#include "gapscope/base/percents.h"

namespace gapscope {
namespace {

using internal::diagnosis::HeldOut;
using internal::diagnosis::place_of;
using internal::diagnosis::Playback;
using internal::diagnosis::SharedUnit;
using testing::facts_of;
using ::testing::HasSubstr;
using testing::slide_diagnosis;
using ::testing::StartsWith;

/// As the torque balance has decided, with a free run that may not bear it out.
Diagnosis by_balance(double shrink, const Interval& ci95) {
  Diagnosis d = slide_diagnosis();
  for (AddedEffect& a : d.added) a.share_of = ShareOf::kTorque;
  d.mismatch.shrink = shrink, d.mismatch.shrink_ci95 = ci95;
  d.mismatch.measure = "free run restarted every 0.5 s, median over windows of the rms";
  return d;
}

TEST(CardBasis, WhatRoundsToZeroHasNoSign) {
  EXPECT_EQ(with_decimals(-0.004, 2), "0.00");
  EXPECT_EQ(with_decimals(-0.0, 0), "0");
  EXPECT_EQ(with_decimals(-0.006, 2), "-0.01");
  EXPECT_EQ(SharedUnit(1.0, "%").with_interval(35.0, {-0.2, 70.2}), "35 %, 95 %: 0 to 70");
  EXPECT_EQ(SharedUnit(1.0, "N").number(-0.0), "0");
  const double both[] = {-0.2, 64.0};
  EXPECT_EQ(Percents(both)(-0.0001), "0.00 %");
}

TEST(CardBasis, ACauseThatTheNextExperimentIsToTellFromAnotherIsLikely) {
  Diagnosis d = slide_diagnosis();
  d.added.resize(1), d.effects.resize(1);
  d.mismatch.shrink_ci95 = {0.9, 1.0};
  EXPECT_EQ(verdict_words(d, Coordinates()), "effect (missing in the model: established)");
  TriedInput best;
  best.separations = {{"motor_coulomb_friction", "stribeck_friction", 0.2},
                      {"stribeck_friction", "motor_coulomb_friction", 0.1}};
  d.next_experiment.tried = {best};
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).cause,
              StartsWith("Likely, not confirmed (Stribeck friction explains nearly as much): motor Coulomb "
                         "friction."));
  EXPECT_EQ(verdict_words(d, Coordinates()), "effect (missing in the model: likely, not confirmed)");
  EXPECT_THAT(
      internal::diagnosis::sentence_of(d, Coordinates()),
      StartsWith("The model lacks motor Coulomb friction (likely; Stribeck friction explains nearly as "
                 "much)"));
  d.added.front().group.push_back("stribeck_friction");  // then it is told as one of two
  EXPECT_EQ(rival_of_first(d), "");
}

TEST(CardBasis, ACauseThatTheFreeRunCannotTellIsSaidToBeOfTheBalanceAlone) {
  const Diagnosis d = by_balance(0.46, {-2.57, 0.83});
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).cause,
              StartsWith("Likely, not confirmed (by the force balance; the free run, restarted again and "
                         "again, cannot tell): motor Coulomb "
                         "friction. "));
  EXPECT_THAT(internal::diagnosis::sentence_of(d, Coordinates()),
              StartsWith("The model lacks motor Coulomb friction (likely, by the torque balance alone; "));
  const Diagnosis shown = by_balance(0.9, {0.59, 1.0});
  EXPECT_THAT(card_of(facts_of(nullptr, &shown)).cause, StartsWith("Established: motor Coulomb friction. "));
  const Diagnosis at_floor = by_balance(kNaN, {});
  EXPECT_THAT(card_of(facts_of(nullptr, &at_floor)).cause,
              StartsWith("Likely, not confirmed (by the force balance; the free run, restarted again and "
                         "again, cannot tell): motor Coulomb "));
  EXPECT_THAT(internal::diagnosis::sentence_of(at_floor, Coordinates()),
              HasSubstr("(likely, by the torque balance alone; the free run, near its floor, cannot tell)"));
  Diagnosis of_a_group = d;
  of_a_group.added.resize(1), of_a_group.added[0].group = {"motor_coulomb_friction", "quadratic_drag"};
  EXPECT_THAT(card_of(facts_of(nullptr, &of_a_group)).cause,
              StartsWith("Either motor Coulomb friction or quadratic drag may be missing (these recordings"));
  Diagnosis by_motion = d;
  for (AddedEffect& a : by_motion.added) a.share_of = ShareOf::kMotion;
  EXPECT_THAT(
      card_of(facts_of(nullptr, &by_motion)).cause,
      StartsWith(
          "Established on these recordings (the free run of another may not show it): motor Coulomb "));
  EXPECT_THAT(
      internal::diagnosis::sentence_of(by_motion, Coordinates()),
      HasSubstr("friction (established; the free run of another recording may not show it: its error shrinks "
                "by 46 % (95 %: -257 to 83))"));
}

/// Of the balance a share is a fall of torque, as its table has it; of the motion one of its error.
TEST(CardBasis, AShareSaysWhatItIsOf) {
  Diagnosis d = by_balance(0.9, {0.6, 1.0});
  d.budget.band_hz = 8.0;
  d.budget.rungs.resize(2);
  d.budget.rungs[0].effect = d.effects[0], d.budget.rungs[0].before = 10.0, d.budget.rungs[0].after = 4.0;
  d.budget.rungs[1].effect = d.effects[1], d.budget.rungs[1].before = 4.0, d.budget.rungs[1].after = 2.0;
  d.mismatch.after_torque = 3.0;  // the fitted model is another one than that of the last line
  EXPECT_THAT(
      card_of(facts_of(nullptr, &d)).helps,
      StartsWith(
          "The missing force falls from 10 N to 4 N with motor Coulomb friction, then to 3 N with cogging "
          "torque; in all from 20.0 % to 6.0 % of what the input applies"));
  Diagnosis behind = d;  // a law between them that is not in the model
  BudgetRung resonance;
  resonance.law = "resonance", resonance.effect = "shaft_compliance";
  behind.budget.rungs.insert(behind.budget.rungs.begin() + 1, resonance);
  behind.budget.rungs[1].after = 3.5;
  EXPECT_EQ(card_of(facts_of(nullptr, &behind)).helps, card_of(facts_of(nullptr, &d)).helps);
  behind.added.insert(behind.added.begin() + 1, behind.added[1]);
  EXPECT_THAT(
      card_of(facts_of(nullptr, &behind)).helps,
      StartsWith("Motor Coulomb friction (brings it from 10 to 4 N), cogging torque and cogging torque "
                 "bring the missing force down from 10 to 3 N"));
  for (AddedEffect& a : d.added) a.share_of = ShareOf::kMotion;
  d.mismatch.measure = "prediction of an observer at 3 Hz, median over windows of the rms";
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              StartsWith("Motor Coulomb friction (cuts the prediction error by 60 %) and "));
  d.laws.push_back({});
  d.laws.front().variable = "speed", d.laws.front().shrink = -0.001;
  EXPECT_THAT(card_of(facts_of(nullptr, &d)).helps,
              HasSubstr("A free curve over the speed cuts the prediction error by 0 % ("));
}

TEST(CardBasis, TheLineOfThePlaceIsASentence) {
  Diagnosis d = slide_diagnosis();
  const auto where = [&](const std::string& headline) {
    d.where.headline = headline;
    return card_of(facts_of(nullptr, &d)).place;
  };
  EXPECT_EQ(where("periodic in the motor position, every 5 mm"),
            "The missing force is periodic in the motor position, every 5 mm.");
  EXPECT_EQ(where("depends on the speed (largest at 34–51 mm/s)"),
            "The missing force depends on the speed (largest at 34–51 mm/s).");
  EXPECT_EQ(where("no clear pattern in angle, speed, input or time"),
            "The missing force has no clear pattern in angle, speed, input or time.");
}

/// A torque that is damping, under ten times as much noise, which the error budget does not count.
TEST(CardBasis, ThePlaceIsOfTheBandThatTheSizeIsOf) {
  std::vector<double> u, x1;
  Playback p;
  constexpr double kStep = 1e-3;
  std::uint32_t draw = 1;
  for (int i = 0; i < 8000; ++i) {
    const double angle = 2.0 * kPi * 0.5 * kStep * i, w = std::sin(angle);
    draw = 1664525u * draw + 1013904223u;
    u.push_back(0.0), x1.push_back(-std::cos(angle)), p.w1.push_back(w);
    p.torque.push_back(w + ((draw >> 31) == 0 ? 10.0 : -10.0));
    p.mode.push_back(Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {1e-6}, held.periods = {0.0};
  EXPECT_THAT(place_of({p}, held, 1.0, {}, nullptr).headline, StartsWith("no clear pattern"));
  EXPECT_THAT(place_of({p}, held, 1.0, {}, nullptr, 5.0).headline, StartsWith("depends on the speed"));
}

/// A gap is crossed twice a second; for 20 ms behind each impact the contact's law leaves a torque.
TEST(CardBasis, WhatTheContactLeavesIsPlacedBehindItsImpacts) {
  std::vector<double> u, x1;
  Playback p;
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 8000; ++i) {
    const int since = i % 500;  // of the impact
    u.push_back(0.0), x1.push_back(0.01 * ((i * 37) % 101)), p.w1.push_back(0.1 * ((i * 53) % 89));
    p.torque.push_back(since < 20 ? (since % 2 == 0 ? 1.0 : -1.0) : (i % 2 == 0 ? 0.01 : -0.01));
    p.mode.push_back(since > 400 ? Mode::kGap : Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {1e-6}, held.periods = {0.0};
  EXPECT_THAT(place_of({p}, held, 1.0, {}, nullptr).headline,
              StartsWith("at impacts and just behind them (100 % of the squared correcting torque in 7 %"));
}

/// One way for a second, then at rest, where the encoder's last count flickers and an observer makes motion
/// of it.
TEST(CardBasis, ADriveThatStandsMovesInNoDirection) {
  constexpr double kStep = 1e-3, kQuantum = 1e-3;
  std::vector<double> u, x1;
  Playback p;
  for (int i = 0; i < 4000; ++i) {
    const bool moves = i < 1000, odd = i % 2 == 1;
    const double x = moves ? 0.4 * kStep * i : 0.4 + (odd ? kQuantum : 0.0);
    u.push_back(0.0), x1.push_back(kQuantum * std::round(x / kQuantum));
    p.w1.push_back(moves ? 0.4 : odd ? 0.1 : -0.1), p.torque.push_back(1.0 + (odd ? 0.1 : 0.0));
    p.mode.push_back(Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1, trace.quantum = kQuantum;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {kQuantum / std::sqrt(12.0)},
  held.periods = {0.0};
  const MismatchPlace place = place_of({p}, held, 1.0, {}, nullptr);
  EXPECT_EQ(place.direction[0].expected, 0.0);
  EXPECT_EQ(place.direction[1].expected, 1.0);
  EXPECT_THAT(place.headline, ::testing::EndsWith("; only forward motion was recorded"));
}

TEST(CardBasis, ACycleOfTheEncodersCountsIsNoFinding) {
  constexpr double kStep = 1e-3, kCounts = 4096.0;
  std::vector<double> u(8000, 0.0), x1;
  Playback p;
  for (int i = 0; i < 8000; ++i) {
    x1.push_back(0.15 * (1.0 - std::cos(2.0 * kPi * 0.125 * kStep * i)));
    p.w1.push_back(0.0), p.torque.push_back(std::sin(kCounts * x1.back()));
    p.mode.push_back(Mode::kEngagementPlus);
  }
  MotorTrace trace;
  trace.dt = kStep, trace.u = u, trace.x1 = x1;
  HeldOut held;
  held.traces = {trace}, held.scored_from = {0}, held.floors = {1e-6}, held.periods = {0.0};
  EXPECT_NEAR(place_of({p}, held, 1.0, {}, nullptr).periods_per_turn, kCounts, 0.01 * kCounts);
  for (const double counts_in_cycle : {1.0, 0.3, 1.9}) {
    held.traces[0].quantum = 2.0 * kPi / kCounts / counts_in_cycle;
    EXPECT_TRUE(std::isnan(place_of({p}, held, 1.0, {}, nullptr).periods_per_turn)) << counts_in_cycle;
  }
  held.traces[0].quantum = 2.0 * kPi / kCounts / 2.1;
  EXPECT_NEAR(place_of({p}, held, 1.0, {}, nullptr).periods_per_turn, kCounts, 0.01 * kCounts);
}

}  // namespace
}  // namespace gapscope
