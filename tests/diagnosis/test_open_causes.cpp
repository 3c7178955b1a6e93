// Causes that the recordings do not determine stay open.
#include <gtest/gtest.h>

#include "diagnosis/verdict.h"

namespace gapscope {
namespace {

using internal::diagnosis::open_undetermined;

/// Both established by the torque balance; the motion comes nearer by them.
Diagnosis of_two(AddedEffect first, AddedEffect second) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kEffect;
  d.effects = {first.effect, second.effect};
  d.group = {first.effect};
  d.mismatch.before = 0.02, d.mismatch.after = 0.01;
  d.added = {std::move(first), std::move(second)};
  for (AddedEffect& a : d.added) a.established = true, a.group = {a.effect};
  return d;
}

NamedValue number(const char* key, double low, double high) {
  return {key, "", 0.5 * (low + high), {low, high}};
}

AddedEffect effect(const char* name, std::vector<NamedValue> parameters) {
  AddedEffect a;
  a.effect = name, a.parameters = std::move(parameters);
  return a;
}

const AddedEffect kFriction = effect("motor_coulomb_friction", {number("level_nm", 0.9, 1.1)});

const AddedEffect kDelay = effect("input_delay", {number("delay_s", 0.9, 1.1)});

Diagnosis judged(Diagnosis d) {
  open_undetermined(d);
  return d;
}

TEST(OpenCauses, AnAmountWhoseIntervalHoldsZeroMayBeNone) {
  const AddedEffect perhaps = effect("load_unbalance", {number("amplitude_nm", -0.8, 7.8)});
  const Diagnosis first = judged(of_two(perhaps, kFriction));
  EXPECT_EQ(first.verdict, DiagnosisVerdict::kHelps);
  EXPECT_FALSE(first.added[0].established);
  EXPECT_TRUE(first.added[1].established);
  const Diagnosis second = judged(of_two(kFriction, perhaps));
  EXPECT_EQ(second.verdict, DiagnosisVerdict::kEffect);
  EXPECT_TRUE(second.added[0].established);
  EXPECT_FALSE(second.added[1].established);
}

TEST(OpenCauses, AKneeThatMayLieAnywhereMayBeNone) {
  const auto sharp = number("sharpness", 0.5, 1.5);
  EXPECT_FALSE(judged(of_two(kFriction, effect("torque_saturation", {number("knee", -5.0, 19.0), sharp})))
                   .added[1]
                   .established);
  EXPECT_TRUE(judged(of_two(kFriction, effect("torque_saturation", {number("knee", 5.0, 9.0), sharp})))
                  .added[1]
                  .established);
}

/// With another effect that is one.
bool is_cause_beside(std::vector<NamedValue> numbers, const char* name, const AddedEffect& other) {
  return judged(of_two(effect(name, std::move(numbers)), other)).verdict == DiagnosisVerdict::kEffect;
}

TEST(OpenCauses, OfALawThatContainsASimplerOneItsOwnShareCounts) {
  const auto level = number("level_nm", 0.9, 1.1), no_level = number("level_nm", -0.1, 0.3);
  const auto is_cause = [](std::vector<NamedValue> numbers, const char* name) {
    return is_cause_beside(std::move(numbers), name, kDelay);
  };
  EXPECT_FALSE(is_cause({level, number("ratio", -0.1, 0.2)}, "load_dependent_friction"));
  EXPECT_TRUE(is_cause({no_level, number("ratio", 0.1, 0.2)}, "load_dependent_friction"));
  const auto none = number("coulomb_ratio", -0.1, 0.2), some = number("viscous_ratio", 0.1, 0.2);
  EXPECT_TRUE(is_cause({level, none, some}, "friction_asymmetry")) << "one of two";
  EXPECT_FALSE(is_cause({level, none, number("viscous_ratio", -0.3, 0.2)}, "friction_asymmetry"));
  EXPECT_TRUE(is_cause({level, number("length_rad", -0.1, 0.2)}, "presliding_friction")) << "has no share";
}

TEST(OpenCauses, ALevelThatTwoLawsShareSaysNothingOfEither) {
  const auto no_level = number("level_nm", -5.0, 6.0), no_share = number("stiction_ratio", -1.0, 2.0);
  const AddedEffect asymmetry = effect("friction_asymmetry", {no_level, number("coulomb_ratio", 0.1, 0.2)});
  EXPECT_TRUE(is_cause_beside({no_level}, "motor_coulomb_friction", asymmetry));
  EXPECT_FALSE(is_cause_beside({no_level}, "motor_coulomb_friction", kDelay));
  EXPECT_TRUE(is_cause_beside({no_level, no_share}, "stribeck_friction", asymmetry))
      << "a share of that level";
  EXPECT_FALSE(is_cause_beside({no_level, no_share}, "stribeck_friction", kDelay));
  EXPECT_FALSE(is_cause_beside({no_level, number("ratio", -0.1, 0.2)}, "load_dependent_friction", asymmetry))
      << "a share of the load";
}

TEST(OpenCauses, ANumberWithoutAnIntervalEstablishesNothing) {
  const Diagnosis first =
      judged(of_two(effect("load_unbalance", {{"amplitude_nm", "N m", 274.0}}), kFriction));
  EXPECT_EQ(first.verdict, DiagnosisVerdict::kHelps);
  EXPECT_FALSE(first.added[0].established);
  EXPECT_TRUE(first.added[1].established);
  const NamedValue level = {"level_nm", "N m", 0.0}, share = {"ratio", "-", 0.3};
  EXPECT_TRUE(is_cause_beside({level, number("ratio", 0.1, 0.5)}, "load_dependent_friction", kDelay));
  EXPECT_FALSE(is_cause_beside({number("level_nm", 0.9, 1.1), share}, "load_dependent_friction", kDelay));
}

TEST(OpenCauses, WhatTheFitDoesNotDetermineTheBalanceMayShowButNotAtABound) {
  Diagnosis d = of_two(effect("load_unbalance", {{"amplitude_nm", "N m", 274.0}}), kFriction);
  d.budget.rungs = {{"load_unbalance", "load_unbalance", true, 2.65, 1.04, 0.85, {0.82, 0.87}}};
  EXPECT_EQ(judged(d).verdict, DiagnosisVerdict::kEffect);
  d.added[0].at_bound = {"amplitude_nm"};
  EXPECT_EQ(judged(d).verdict, DiagnosisVerdict::kHelps);
  EXPECT_FALSE(judged(d).added[0].established);
  d.added[0].at_bound = {"phase_rad"};
  EXPECT_EQ(judged(d).verdict, DiagnosisVerdict::kEffect) << "which is no amount";
  d.budget.rungs[0].share_ci95.low = -0.1;
  EXPECT_EQ(judged(d).verdict, DiagnosisVerdict::kHelps);
}

TEST(OpenCauses, ACoarserCountIsReadAndNeedsNoInterval) {
  EXPECT_TRUE(is_cause_beside({{"quantum_rad", "rad", 1e-3}}, "encoder_quantization", kDelay));
}

TEST(OpenCauses, EffectsThatBringTheMotionNoNearerAreNone) {
  Diagnosis d = of_two(kFriction, kFriction);
  d.mismatch.after = 0.03;
  d = judged(d);
  EXPECT_EQ(d.verdict, DiagnosisVerdict::kHelps);
  EXPECT_FALSE(d.added[0].established || d.added[1].established);
}

}  // namespace
}  // namespace gapscope
