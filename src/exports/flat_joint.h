#pragma once

#include <span>

#include "exports/carried.h"

namespace gapscope::internal::exports {

/// What is left of a drive in one joint.
struct FlatJoint {
  double armature = 0.0;                                 ///< inertia of the motor [kg m²]
  double link = 0.0;                                     ///< of the load [kg m²]
  double damping = 0.0;                                  ///< of both [N m s/rad]
  double friction = 0.0;                                 ///< of both, at speed [N m]
  double break_away = 0.0;                               ///< beyond it, at rest [N m]
  double stribeck_speed = 0.0, stribeck_exponent = 2.0;  ///< at which that has gone [rad/s]
  double load_share = 0.0;                               ///< friction per torque of the gears [-]
  double unbalance = 0.0, unbalance_phase = 0.0;
  KnownMass hangs = {};          ///< what is known to make it
  bool limited = false;          ///< the output is held: the joint moves within the gap
  double low = 0.0, high = 0.0;  ///< [rad]
  double effort = 0.0;           ///< most torque that the input brings [N m]
};

FlatJoint flat_joint(const ExportSource& source);

/// The certificate of a format of this kind: its table's rows, and the error of inertia, damping, friction
/// and, where the format has it, unbalance, in an engine that makes no error of its own.
Certificate flat_certificate(const ExportSource& source, std::span<const Carriage> table,
                             bool with_unbalance);

}  // namespace gapscope::internal::exports
