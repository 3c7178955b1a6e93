#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/words.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string sentence(std::vector<std::string> effects) {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kEffect;
  d.effects = std::move(effects);
  d.mismatch.shrink = 0.9;
  return internal::diagnosis::sentence_of(d, Coordinates::kRotation);
}

TEST(Words, AnEffectThatBringsASimplerOneSaysSo) {
  EXPECT_THAT(sentence({"friction_asymmetry"}),
              HasSubstr("lacks friction asymmetry (which contains motor Coulomb friction): with it"));
  EXPECT_THAT(sentence({"motor_coulomb_friction", "friction_asymmetry"}), Not(HasSubstr("contains")));
  EXPECT_THAT(sentence({"cogging_torque"}), Not(HasSubstr("contains")));
}

TEST(Words, WhatShrinksIsWhatIsAboveTheFloor) {
  EXPECT_THAT(sentence({"cogging_torque"}), HasSubstr("shrinks by 90 % of what is above the floor"));
}

TEST(Words, AStribeckFrictionOfNegativeRatioIsFrictionThatIsLowerAtLowSpeed) {
  Diagnosis d;
  d.effects = {"stribeck_friction"};
  d.mismatch.shrink = 0.9;
  AddedEffect added;
  added.effect = "stribeck_friction";
  added.parameters = {{"level_nm", "N m", 1.0}, {"stiction_ratio", "-", -0.5}};
  for (const auto verdict : {DiagnosisVerdict::kEffect, DiagnosisVerdict::kHelps}) {
    d.verdict = verdict;
    added.established = verdict == DiagnosisVerdict::kEffect;
    added.parameters[1].value = -0.5, d.added = {added};
    EXPECT_THAT(internal::diagnosis::sentence_of(d, Coordinates::kRotation),
                HasSubstr("friction that is lower at low speed"));
    added.parameters[1].value = 0.5, d.added = {added};
    EXPECT_THAT(internal::diagnosis::sentence_of(d, Coordinates::kRotation), Not(HasSubstr("lower")));
  }
}

}  // namespace
}  // namespace gapscope
