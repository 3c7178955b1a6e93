#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/mjcf.h"
#include "gapscope/recording/controller.h"

namespace gapscope::internal::config {

/// What the actuators of one joint do to it: torque = gain · ctrl + constant, or that of a servo whose
/// control is a goal.
struct Actuation {
  double gain = kNaN;        ///< of the first one that has any [N m per unit of the control]
  double constant = 0.0;     ///< bias of all of them [N m]
  double lag = 0.0;          ///< time constant of that one's filter [s]; 0: none
  double limit = kInfinity;  ///< of its control, by ctrlrange or forcerange, which are alike both ways
  double back_emf = 0.0;     ///< damping that a motor under a voltage brings [N m s/rad]
  std::optional<DriveController> servo;  ///< its control is a goal of position or speed; then gain is 1
  std::vector<std::string> notes;        ///< what was left aside
};

/// @throws ConfigError where an attribute is no number
Actuation actuation_of(const Mjcf& mjcf, const std::string& joint);

}  // namespace gapscope::internal::config
