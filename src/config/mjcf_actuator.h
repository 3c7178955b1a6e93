#pragma once

#include <string>
#include <vector>

#include "config/mjcf.h"

namespace gapscope::internal::config {

/// What the actuators of one joint do to it: torque = gain · ctrl + constant.
struct Actuation {
  double gain = kNaN;              ///< of the first one that has any [N m per unit of the control]
  double constant = 0.0;           ///< bias of all of them [N m]
  double lag = 0.0;                ///< time constant of that one's filter [s]; 0: none
  double limit = kInfinity;        ///< of its control, by ctrlrange or forcerange, which are alike both ways
  std::vector<std::string> notes;  ///< what was left aside
};

/// @throws ConfigError where an attribute is no number
Actuation actuation_of(const Mjcf& mjcf, const std::string& joint);

}  // namespace gapscope::internal::config
