#pragma once

#include <span>

#include "gapscope/reference/fit.h"
#include "signals/one_body.h"

namespace gapscope::internal::reference {

/// How much torque a unit of u makes, by what the model knows in units of torque or inertia.
struct TorqueScale {
  signals::OneBody body;   ///< of the recordings, what is known of their torques apart
  double constant = kNaN;  ///< [N m per unit of u]; NaN: nothing is known
};

/// The momentum balance of the recordings beside what is known of the model: an inertia that is fixed, else
/// the torque of effects whose size is given (the gravity of a mass), else a dry friction that is given, else
/// the inertia that is sought from where it starts. For starting points only.
TorqueScale torque_scale(std::span<const MotorTrace> recordings, const ReferenceModel& model);

}  // namespace gapscope::internal::reference
