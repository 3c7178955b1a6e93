#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"
#include "results/blind_records.h"

namespace gapscope::blind {

ToldPlace told_place(const MismatchPlace& place);

/// Whether the place that was told is the one where an effect acts, by what its entry in the catalogue says
/// of it. The rule, which was written before any answer was scored by it:
///   friction of the motor                 follows the direction of motion
///   quadratic_drag                        along the speed
///   cogging_torque, torque_ripple         periodic in the motor angle, at the true cycles per turn within
///                                         5 %
///   load_unbalance, *_eccentricity        periodic in the motor angle, once per turn
///   torque_saturation, input_dead_zone    along the input level
///   input_delay, *_lag                    where the torque changes
///   gap_growth, viscous_drift, load_inertia_variation   changing over time
///   constant_load_torque                  in engagement, where alone the motor feels it
///   shaft_compliance, impact_damping      in engagement or at impacts
///   contact_adhesion                      in engagement or in the gap, between which it acts
///   encoder_quantization                  within the count of the encoder
/// @param cycles_per_turn  of an effect that repeats with the motor angle
bool names_the_place(const ToldPlace& told, const std::string& effect, double cycles_per_turn);

}  // namespace gapscope::blind
