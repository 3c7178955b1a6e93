#pragma once

#include "diagnosis/diagnose.h"

namespace gapscope::internal::diagnosis {

/// Puts into the diagnosis what of each candidate that is not in its model would have been named.
///
/// The rule that would have named it is foretold: that of the torque balance where the model is off the floor
/// and the balance says most of the input, else that of the simulator.
void tell_detectable(const Study& study, const FirstSearch& found, Diagnosis& diagnosis);

/// The same for the torque balance, see torque_view::LeastNamed.
/// @param asked in the order of the catalogue
std::vector<DetectableEffect> detectable_in_torque(const Study& study, const FirstSearch& found,
                                                   const std::vector<const EffectEntry*>& asked);

/// The same for the simulator: the amount at which the score S of the model, on the recordings as the effect
/// would have changed them, would exceed that with the effect by what tells two models apart.
std::vector<DetectableEffect> detectable_in_motion(const Study& study, const ReferenceModel& model,
                                                   const std::vector<const EffectEntry*>& asked);

/// One that these recordings cannot show.
DetectableEffect not_detectable(const EffectEntry& entry, std::string hidden_by, std::string why);

/// With the values of the effect: the parameter at a place is its size.
DetectableEffect detectable_from(const EffectEntry& entry, const std::vector<double>& values,
                                 std::size_t size_at, double torque);

}  // namespace gapscope::internal::diagnosis
