#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// How far a pattern orders a correcting torque.
struct PatternStrength {
  ResidualPattern pattern = ResidualPattern::kMode;
  /// 0: none; 1: all of the correcting torque. Share of its square that means over the quantity explain; for
  /// time and mode, what is elsewhere than it would be at random.
  double strength = 0.0;
};

/// Cycles per turn of an effect along the motor angle: its own parameter, else one. NaN for other effects.
double cycles_of(const ModelEffect& effect);

/// The phase of contact with most of the error, or where it is densest, if that is clear. Nothing where there
/// is but one.
std::optional<ContactPhase> densest_phase(const std::vector<MapShare>& mode);

/// What the correcting torque follows: that of an effect that was found, always, then the strongest pattern.
/// Where an effect explains it, what is uneven over time is the motion that brings it about.
std::vector<ResidualPattern> followed_patterns(const std::vector<PatternStrength>& patterns,
                                               const ModelEffect* effect);

/// A direction that takes too little of the time in motion to be compared with the other one.
struct LackingWay {
  std::string way;    ///< "forward" or "backward"
  bool none = false;  ///< nothing of it was recorded
};

/// Nothing where both directions take enough.
std::optional<LackingWay> lacking_way(const std::vector<MapShare>& direction);

}  // namespace gapscope::internal::diagnosis
