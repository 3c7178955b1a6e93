#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "drives.h"
#include "gapscope/plant/effect.h"
#include "stamped_file.h"
#include "support/data.h"
#include "torque_view/effect_values.h"
#include "torque_view/ladder.h"

namespace gapscope::internal::torque_view {
namespace {

using test::kInertia, test::Motion;
using Torque = std::function<double(const Motion&)>;

double side(double w) { return w > 0.0 ? 1.0 : -1.0; }

/// Fitted on one motion, judged on the same at other phases.
Budget diagnosed(const Torque& extra, double noise = 0.01) {
  return error_budget({{test::recorded(extra, 0.3, noise)}, {test::recorded(extra, 1.7, noise)}});
}

std::vector<std::string> names(const Budget& b) {
  std::vector<std::string> all;
  for (std::size_t i = 2; i < b.model.size(); ++i) all.emplace_back(b.model[i].law->name);
  return all;
}

/// The torque that a command of dead zone b must ask for is u = τ + b sign τ, and so on: inverse laws.
double tau(const Motion& m) { return kInertia * m.a + test::kDamping * m.w; }

TEST(Ladder, EveryLawNamesAnEffectOfTheCatalogueOrNone) {
  for (const Law& l : laws()) EXPECT_TRUE(*l.effect == '\0' || find_effect(l.effect) != nullptr) << l.name;
}

TEST(Ladder, AnUnbalanceIsNamedAndMeasured) {
  const Budget b = diagnosed([](const Motion& m) { return 0.4 * std::sin(m.x + 0.5); });
  ASSERT_EQ(names(b), std::vector<std::string>{"load_unbalance"});
  EXPECT_TRUE(b.rungs.front().named);
  EXPECT_NEAR(b.model[2].theta.norm(), 0.4, 0.01);
  EXPECT_NEAR(std::atan2(b.model[2].theta[1], b.model[2].theta[0]), 0.5, 0.02);
  EXPECT_NEAR(first_coefficient(b.model, "inertia"), kInertia, 0.02 * kInertia);
  EXPECT_GT(b.shares.front().last.share, 0.9);
}

// With friction and ripple still missing, another period than one turn fits this multisine better.
TEST(Ladder, GravityIsNoCoggingTorqueWhosePeriodOtherEffectsHaveBent) {
  SplitRecordings data{{test::rippling_pendulum(test::multisine(6))},
                       {test::rippling_pendulum([](double t) { return test::triangle(t, 0.7); })}};
  data.new_phase = true;
  const Budget b = error_budget(data);
  EXPECT_EQ(names(b),
            (std::vector<std::string>{"load_unbalance", "motor_coulomb_friction", "torque_ripple"}));
  EXPECT_TRUE(b.rungs.front().named);
}

TEST(Ladder, TheFirstOfTwoIsNamedThoughTheSecondWasItsRival) {
  const Budget b = diagnosed([](const Motion& m) { return 0.12 * side(m.w) + 0.1 * std::sin(9.0 * m.x); });
  ASSERT_GE(b.rungs.size(), 2u);
  const Rung &first = b.rungs[0], &second = b.rungs[1];
  const auto alone = std::find_if(first.ranking.begin(), first.ranking.end(),
                                  [&](const Candidate& c) { return c.law == second.choice().law; });
  ASSERT_NE(alone, first.ranking.end());
  EXPECT_LT(margin_over(first.choice().evidence, alone->evidence), TorqueViewOptions{}.least_margin);
  EXPECT_TRUE(first.named) << first.choice().law->name;
  EXPECT_TRUE(second.named) << second.choice().law->name;
}

// Above its swing the load is not felt: a band that ends where inertia seems to be lost would not show it.
TEST(Ladder, ALoadOnASpringIsNamedAndMeasuredWithFrictionOfItsOwn) {
  SplitRecordings data{{test::sprung_load(test::multisine(3))}, {test::sprung_load(test::multisine(4))}};
  data.new_phase = true;
  const Budget b = error_budget(data);
  EXPECT_GT(b.band.hz, 6.0);
  const Term* spring = spring_of(b.model);
  ASSERT_NE(spring, nullptr);
  EXPECT_THAT(names(b), ::testing::UnorderedElementsAre("motor_coulomb_friction", "resonance"));
  for (const Rung& r : b.rungs) EXPECT_TRUE(r.named || !r.helps);
  EXPECT_NEAR(spring->shape.at, 6.0, 0.06);
  EXPECT_NEAR(spring->theta[0], 0.0015, 0.00006);
  EXPECT_NEAR(spring->theta[0] * spring->shape.rub, 0.03, 0.003);
  EXPECT_NEAR(first_coefficient(b.model, "inertia"), 0.0025, 0.0001) << "of motor and load";
  EXPECT_NEAR(first_coefficient(b.model, "motor_coulomb_friction"), 0.03, 0.003) << "of both";
}

TEST(Ladder, NothingIsAddedToADriveThatLacksNothing) {
  for (const double noise : {0.01, 0.1})
    EXPECT_EQ(names(diagnosed([](const Motion&) { return 0.0; }, noise)), std::vector<std::string>{})
        << noise;
}

TEST(Ladder, CoulombFrictionComesBeforeTheLawsThatContainIt) {
  const Budget b = diagnosed([](const Motion& m) { return 0.2 * side(m.w); });
  ASSERT_FALSE(names(b).empty());
  EXPECT_EQ(names(b).front(), "motor_coulomb_friction");
  EXPECT_NEAR(first_coefficient(b.model, "motor_coulomb_friction"), 0.2, 0.01);
}

TEST(Ladder, TwoEffectsAreTwoRungs) {
  const Budget b = diagnosed([](const Motion& m) { return 0.2 * side(m.w) + 0.1 * std::sin(9.0 * m.x); });
  const auto found = names(b);
  EXPECT_EQ(std::count(found.begin(), found.end(), "motor_coulomb_friction"), 1);
  const Term* line = find_term(b.model, "cogging_torque");
  ASSERT_NE(line, nullptr);
  EXPECT_NEAR(line->shape, 9.0, 0.02);
  EXPECT_NEAR(line->theta.norm(), 0.1, 0.01);
}

/// A line of period 2π/9 with a second harmonic of a phase of its own, and a third of half its size.
double notched(const Motion& m) {
  return 0.1 * std::sin(9.0 * m.x) + 0.05 * std::cos(18.0 * m.x + 0.3) + 0.025 * std::sin(27.0 * m.x - 1.0);
}

TEST(Ladder, TheHarmonicsOfALineAreAddedWhereTheyHelp) {
  const Budget b = diagnosed(notched);
  ASSERT_NE(find_term(b.model, "cogging_torque"), nullptr);
  const Term& line = *find_term(b.model, "cogging_torque");
  EXPECT_NEAR(line.shape, 9.0, 0.02);
  for (const auto& [name, harmonic, size] :
       {std::tuple{"second_harmonic_of_cogging", 2, 0.5}, {"third_harmonic_of_cogging", 3, 0.25}}) {
    const Term* term = find_term(b.model, name);
    ASSERT_NE(term, nullptr) << name;
    EXPECT_EQ(term->shape, line.shape);
    const auto [sine, cosine] = harmonic_values(term->theta, harmonic, line.theta);
    EXPECT_NEAR(std::hypot(sine, cosine), size, 0.03) << name;
  }
  const auto [sine, cosine] =
      harmonic_values(find_term(b.model, "second_harmonic_of_cogging")->theta, 2, line.theta);
  EXPECT_NEAR(std::atan2(cosine, sine), 0.5 * kPi + 0.3, 0.1);  // of the line's own phase, which is zero
}

TEST(Ladder, ALineWithoutHarmonicsGetsNone) {
  const auto found = names(diagnosed([](const Motion& m) { return 0.1 * std::sin(9.0 * m.x); }));
  EXPECT_EQ(found, std::vector<std::string>{"cogging_torque"});
}

/// Dahl's bristle between the samples, of 0.05 rad.
TEST(Ladder, BristlesAreWhatTheyBearLessThanCoulombFriction) {
  double z = 0.0, before = 0.0;
  const Budget b = diagnosed([&](const Motion& m) {
    if (m.t == 0.0) z = 0.0, before = m.x;
    const double move = m.x - before, way = side(move);
    z = way + (z - way) * std::exp(-std::abs(move) / 0.05);
    before = m.x;
    return 0.2 * z;
  });
  const auto found = names(b);
  EXPECT_EQ(std::count(found.begin(), found.end(), "motor_coulomb_friction"), 1);
  const Term* bristle = find_term(b.model, "presliding_friction");
  ASSERT_NE(bristle, nullptr);
  EXPECT_NEAR(first_coefficient(b.model, "motor_coulomb_friction"), 0.2, 0.03);
  EXPECT_NEAR(bristle->theta[0], 0.2, 0.05);  // all of it bends
}

struct Implant {
  const char* law;
  Torque extra;
};

/// Each law by a formula of its own, beside an inertia and a viscous damping: first, or of the first's group.
TEST(Ladder, EveryLawIsFirstWhereItIsTheTruth) {
  const Implant implants[] = {
      {"constant_load_torque", [](const Motion&) { return 0.1; }},
      {"quadratic_drag", [](const Motion& m) { return 0.01 * m.w * std::abs(m.w); }},
      {"input_dead_zone", [](const Motion& m) { return 0.1 * side(tau(m)); }},
      {"torque_saturation", [](const Motion& m) { return 0.5 * std::pow(tau(m), 3); }},
      {"torque_ripple", [](const Motion& m) { return 0.3 * tau(m) * std::sin(5.0 * m.x); }},
      {"load_inertia_variation", [](const Motion& m) { return m.t > 6.0 ? 0.4 * kInertia * m.a : 0.0; }},
      {"viscous_drift", [](const Motion& m) { return 0.05 * m.w * (1.0 - std::exp(-m.t / 4.0)); }},
  };
  for (const Implant& implant : implants) {
    const Budget b = diagnosed(implant.extra);
    ASSERT_FALSE(b.rungs.empty()) << implant.law;
    const Rung& first = b.rungs.front();
    ASSERT_FALSE(first.ranking.empty()) << implant.law;
    const bool in_group = std::count(first.group.begin(), first.group.end(), implant.law) > 0;
    EXPECT_TRUE(first.choice().law->name == std::string(implant.law) || in_group)
        << implant.law << ": " << first.choice().law->name;
    EXPECT_TRUE(first.helps) << implant.law;
  }
}

TEST(Ladder, WhatCouldHaveBeenSeenIsForeseen) {
  const Budget b = diagnosed([](const Motion& m) { return 0.05 * std::sin(m.x); }, 0.1);
  for (const Share& s : b.shares) {
    EXPECT_NEAR(s.seen.predicted, s.last.share, 0.1);
    EXPECT_GT(s.seen.smallest, 0.0);
  }
}

using test::read_stamped;

StampedTrace real(const char* folder, const std::string& name) {
  return read_stamped((testing::data_folder() / folder / name).string());
}

TEST(LadderOnRealDrives, ABallScrewLacksFrictionThatDiffersWithTheDirection) {
  GAPSCOPE_NEEDS_DATA();
  StampedTrace whole = real("emps", "emps_train.csv");
  whole.held_command = true;
  SplitRecordings data{{test::between(whole, 0.0, 0.5)}, {test::between(whole, 0.5, 1.0)}};
  data.turns = ShaftTurns::of_a_slide();
  const Budget b = error_budget(data);
  ASSERT_FALSE(b.rungs.empty());
  const auto asymmetric =
      std::find_if(b.rungs.front().ranking.begin(), b.rungs.front().ranking.end(),
                   [](const Candidate& c) { return std::string_view(c.law->name) == "friction_asymmetry"; });
  ASSERT_NE(asymmetric, b.rungs.front().ranking.end());
  EXPECT_GT(asymmetric->evidence.share, 0.965);
  EXPECT_STREQ(b.rungs.front().choice().law->name, "motor_coulomb_friction");
  EXPECT_NEAR(first_coefficient(b.model, "inertia"), 95.1, 2.0);
  EXPECT_NEAR(find_term(b.model, "motor_coulomb_friction")->theta[0], 20.4, 3.0);
  const Term* line = find_term(b.model, "cogging_torque");
  ASSERT_NE(line, nullptr);
  EXPECT_NEAR(2.0 * kPi / line->shape, 2.5e-3, 2e-5);
  EXPECT_LT(b.rms, 1.0);
}

TEST(LadderOnRealDrives, AServoLacksItsPendulumFirstByFar) {
  GAPSCOPE_NEEDS_DATA();
  int first = 0;
  for (const char* motion : {"sin_sin", "sin_time_square", "up_and_down", "lift_and_drop"})
    for (const auto& [fit, judge] : {std::pair{"_kp100.csv", "_kp400.csv"}, {"_kp400.csv", "_kp100.csv"}}) {
      const std::string name = motion;
      const Budget b = error_budget({{real("xl330", name + fit)}, {real("xl330", name + judge)}});
      ASSERT_FALSE(b.rungs.empty()) << name;
      const Rung& rung = b.rungs.front();
      if (rung.named && rung.choice().law->name == std::string("load_unbalance") &&
          rung.choice().evidence.share > 0.8)
        ++first;
    }
  EXPECT_GE(first, 6);  // up_and_down is so slow that its inertia is not seen
}

TEST(LadderOnRealDrives, FrictionOfAServosGearsGrowsWithItsLoadAndLeavesNoneToCoulomb) {
  GAPSCOPE_NEEDS_DATA();
  SplitRecordings data;
  data.new_phase = true;
  for (const std::string motion : {"sin_sin", "lift_and_drop", "sin_time_square", "up_and_down"}) {
    data.fit.push_back(real("xl330", motion + "_kp100.csv"));
    data.judge.push_back(real("xl330", motion + "_kp400.csv"));
  }
  const Budget b = error_budget(data);
  ASSERT_EQ(b.shares.size(), 2u);
  EXPECT_STREQ(b.shares[0].law->name, "load_unbalance");
  EXPECT_STREQ(b.shares[1].law->name, "load_dependent_friction");
  EXPECT_TRUE(b.rungs[1].named);
  EXPECT_GT(b.shares[1].last.share, 1.0 - 0.85 * 0.85);  // 15 % of the rms
  EXPECT_GT(b.shares[1].last.interval.low, 0.0);
  EXPECT_NEAR(b.shares[1].theta[0], 0.4, 0.05);
}

// Its author: gap and friction without preload, friction and compliance with it.
TEST(LadderOnRealDrives, AGearboxWithALockedOutputLacksFrictionFirst) {
  GAPSCOPE_NEEDS_DATA();
  for (const char* preload : {"00_preload.csv", "10_preload.csv"}) {
    StampedTrace whole = real("preload_ladder", preload);
    const auto [low, high] = std::minmax_element(whole.x.begin(), whole.x.end());
    SplitRecordings data{{test::between(whole, 0.0, 0.667)}, {test::between(whole, 0.667, 1.0)}};
    data.held_output = true;
    data.known = {contact_term(*low, *high)};
    const Budget b = error_budget(data);
    ASSERT_FALSE(b.rungs.empty()) << preload;
    const Rung& rung = b.rungs.front();
    EXPECT_STREQ(rung.choice().law->name, "motor_coulomb_friction") << preload;
    const Candidate& best = rung.ranking.front();  // friction with all that may come with it
    EXPECT_THAT(best.law->name, ::testing::AnyOf(::testing::StrEq("motor_coulomb_friction"),
                                                 ::testing::StrEq("presliding_friction")))
        << preload;
    EXPECT_GT(best.evidence.share, 0.75) << preload;
    EXPECT_EQ(find_term(b.model, "input_dead_zone"), nullptr) << preload;
  }
}

}  // namespace
}  // namespace gapscope::internal::torque_view
