#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/diagnosis/named_value.h"
#include "gapscope/reference/fit.h"

namespace gapscope {

/// A node of a law of last resort: what the drive lacks there.
struct CurvePoint {
  double at = kNaN;      ///< speed w1 [rad/s], position x1 [rad] or input u
  int direction = 0;     ///< sign of the motion that it holds for; 0: both
  double torque = kNaN;  ///< to be added to the model's torque on the motor [N m]
  Interval ci95;
};

/// What models leave in one bin of the variable, as means over the held-out samples in it.
struct ResidualBin {
  double at = kNaN;   ///< middle of the bin
  int direction = 0;  ///< of the motion
  int samples = 0;
  double before = kNaN, after = kNaN;  ///< correcting torque without and with the law [N m]
};

/// A law of last resort: what remains is a function of speed, position or input. It stands for no cause.
struct LastResortLaw {
  std::string law;                     ///< "friction_curve", "position_torque" or "input_curve"
  std::string variable;                ///< "speed", "position" or "input"
  std::vector<std::string> group;      ///< itself, and the laws of other variables that do nearly as well
  std::vector<std::string> on_top_of;  ///< effects of the model that it was added to
  std::vector<NamedValue> parameters;
  double shrink = kNaN;  ///< (before − after)/(before − floor) of the held-out error
  Interval shrink_ci95;
  double before = kNaN, after = kNaN;                ///< the held-out error [rad]
  double before_torque = kNaN, after_torque = kNaN;  ///< median of windows of the correcting torque [N m]
  std::vector<CurvePoint> curve;                     ///< in rising order of `at`
  std::vector<ResidualBin> residual;
  ReferenceModel fitted;  ///< the model with the law; not stored
};

}  // namespace gapscope
