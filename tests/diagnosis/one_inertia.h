#pragma once

#include "blind/blind_pair.h"

namespace gapscope::test {

/// A drive of the independent plant without a load behind a gap, so that backlash is a candidate: recorded
/// under a sine, held out under steps, its sheet 20 % off.
inline blind::BlindPair one_inertia(const independent_plant::MotorEffects& effects, std::uint64_t seed,
                                    const independent_plant::OutsideEffects& outside = {}) {
  independent_plant::BlindCase c;
  c.drive.load = independent_plant::BlindLoad::kNone;
  c.drive.motor_inertia *= 2.0;
  c.drive.effects.motor = effects;
  c.drive.effects.outside = outside;
  c.options = {1000.0, 5.0, seed, independent_plant::kFastTolerance};
  c.sensor = independent_plant::BlindSensor::with_bits(16, 0.5);
  c.excitation.amplitude = 1.2;
  blind::BlindPair pair;
  pair.train = simulate_blind(c).recording;
  c.excitation.waveform = independent_plant::Waveform::kSteps;
  pair.held_out = simulate_blind(c).recording;
  pair.sheet.structure.has_load = false;
  pair.sheet.parameters[place::kMotorInertia] = {1.6 * 8.78e-4, true, kNaN, kNaN, {}};
  pair.sheet.parameters[place::kTorqueConstant].value = 0.172;
  pair.sheet.parameters[place::kMotorDamping] = {0.05, true, kNaN, kNaN, {}};
  return pair;
}

}  // namespace gapscope::test
