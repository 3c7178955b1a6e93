#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/diagnosis/named_value.h"

namespace gapscope {

/// What a share of an added effect is of: the error of the held-out motion, or the missing torque, which has
/// then decided on it.
enum class ShareOf { kMotion, kTorque };

/// An effect that was added to the model: what it takes of the held-out error, and whether it is its cause.
struct AddedEffect {
  std::string effect;
  /// No other effect and no free law of another variable does nearly as well, the interval of its amount has
  /// more than none of it, and the held-out motion comes nearer
  bool established = false;
  std::vector<std::string> group;  ///< itself, and the rivals that this recording cannot tell from it
  double probability = kNaN;
  std::vector<NamedValue> parameters;
  double shrink = kNaN;  ///< (before − after)/(before − floor) of this step alone
  Interval shrink_ci95;
  double after_torque = kNaN;              ///< rms of the missing torque with it [N m]
  std::vector<std::string> at_bound = {};  ///< keys of its parameters that ended at a bound of their search
  ShareOf share_of = ShareOf::kMotion;     ///< what `shrink` is of
};

}  // namespace gapscope
