// The facts of a card of a slide, for its tests.
#pragma once

#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/telling/card.h"
#include "telling/answer.h"

namespace gapscope::testing {

inline Answer sharp_answer() {
  Answer a;
  a.gap = 0.019, a.ci95 = {0.018, 0.020}, a.from = AnswerSource::kModelFree, a.trust = AnswerTrust::kGood;
  go_on(a, {{"gap.model_free", {number("gap", a.gap, "rad", a.ci95)}}}, Coordinates::kRotation);
  return a;
}

/// 10 N of 50 N, of which friction takes 6 and a rivalled cogging 2 more.
inline Diagnosis slide_diagnosis() {
  Diagnosis d;
  d.verdict = DiagnosisVerdict::kEffect;
  d.effects = {"motor_coulomb_friction", "cogging_torque"};
  d.added = {{"motor_coulomb_friction", true, {"motor_coulomb_friction"}, kNaN, {}, 0.6, {}, 4.0},
             {"cogging_torque", false, {"cogging_torque", "torque_ripple"}, kNaN, {}, 0.5, {}, 2.0}};
  d.mismatch.before = 3e-3, d.mismatch.after = 1e-3, d.mismatch.floor = 1e-4;
  d.mismatch.before_torque = 10.0, d.mismatch.after_torque = 2.0, d.mismatch.input_torque = 50.0;
  d.where.headline = "depends on the direction of motion (55 % of its square backward)";
  return d;
}

inline CardFacts facts_of(const Answer* answer, const Diagnosis* diagnosis) {
  CardFacts f;
  f.answer = answer, f.diagnosis = diagnosis;
  f.coordinates = Coordinates::kTranslation;
  return f;
}

}  // namespace gapscope::testing
