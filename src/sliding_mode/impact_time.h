#pragma once

#include "sliding_mode/release.h"
#include "sliding_mode/transition.h"

namespace gapscope::internal {

/// The instant of an impact, by local fits.
struct ImpactTime {
  bool found = false;
  double time = 0.0;          ///< [samples]
  double half_width = 0.0;    ///< over the kinks that fit almost as well [s]
  double position = 0.0;      ///< x1 [rad]
  double speed = 0.0;         ///< of the motor just before [rad/s]
  double acceleration = 0.0;  ///< of the motor just before [rad/s²]
};

/// Kinks (t − t2)₊^p on a quadratic, p = 1 (rigid), 2 (damped) or 3 (elastic contact), around the event. The
/// window after it is tied to the excursion, because a light load rings within a millisecond.
ImpactTime refine_impact(const TransitionContext& context, const Event& impact, const Reversal& reversal);

}  // namespace gapscope::internal
