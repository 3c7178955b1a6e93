#pragma once

#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/telling/card.h"

namespace gapscope {

/// 0.1 N m, of which friction takes 0.06 and a delay 0.02 more.
inline Diagnosis of_friction_and_delay(bool first, bool second) {
  Diagnosis d;
  d.verdict = first ? DiagnosisVerdict::kEffect : DiagnosisVerdict::kHelps;
  d.effects = {"motor_coulomb_friction", "input_delay"};
  d.added = {{"motor_coulomb_friction",
              first,
              {"motor_coulomb_friction", "quadratic_drag"},
              kNaN,
              {},
              0.6,
              {},
              0.04},
             {"input_delay", second, {"input_delay"}, kNaN, {}, 0.5, {}, 0.02}};
  d.mismatch.before = 3e-3, d.mismatch.after = 1e-3, d.mismatch.floor = 1e-4;
  d.mismatch.before_torque = 0.1, d.mismatch.after_torque = 0.02, d.mismatch.input_torque = 0.5;
  return d;
}

inline Card card_of(const Diagnosis& d) {
  CardFacts f;
  f.diagnosis = &d;
  return gapscope::card_of(f);
}

}  // namespace gapscope
