#pragma once

#include <string>
#include <vector>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// A way in which a residual torque can be ordered, and how far it is.
enum class Pattern { kAngle, kDirection, kSpeed, kInput, kTime, kInputSteps, kCounts, kMode };

struct PatternStrength {
  Pattern pattern = Pattern::kMode;
  double strength =
      0.0;  ///< 0: none; 1: all of the residual torque. Share of its square that means over the
            ///< quantity explain; for time and mode, what is elsewhere than it would be at random
};

/// The quantity that an effect acts along, by what its parameters are measured in.
Pattern pattern_of(const EffectEntry& effect);

/// Cycles per turn of an effect along the motor angle: its own parameter, else one. NaN for other effects.
double cycles_of(const ModelEffect& effect);

/// The place of a mismatch in words: the mode where it is densest, and what it follows. The pattern of an
/// effect that was found is always named.
std::string headline_of(const MismatchPlace& place, const std::vector<PatternStrength>& patterns,
                        const ModelEffect* effect, bool rotation);

}  // namespace gapscope::internal::diagnosis
