#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// What a simulator's model says of one joint's drive; NaN: nothing.
struct JointNumbers {
  std::string model, joint;       ///< the file and the name in it
  bool slides = false;            ///< rad reads m, N m reads N
  double inertia = kNaN;          ///< of the motor's side, or of all that turns [kg m²]
  double body_inertia = kNaN;     ///< of it, the body's own, without the armature; of MJCF [kg m²]
  double damping = kNaN;          ///< [N m s/rad]
  double friction = kNaN;         ///< dry, on the motor's side [N m]
  double torque_constant = kNaN;  ///< [N m per unit of the control]
  double unbalance = kNaN;  ///< gravity's torque −G sin(x + phase), on the load where there is one [N m]
  double unbalance_phase = 0.0;    ///< [rad]
  double gap = kNaN;               ///< [rad]; the numbers below belong to it
  double load_inertia = kNaN;      ///< [kg m²]
  double load_damping = kNaN;      ///< [N m s/rad]
  double load_friction = kNaN;     ///< [N m]
  double stiffness = kNaN;         ///< of the contact [N m/rad]
  double contact_damping = kNaN;   ///< [N m s/rad]
  std::vector<std::string> notes;  ///< what was left aside, as sentences
};

/// Reads a joint of an MJCF (`mujoco`) or URDF (`robot`). Of MJCF: armature, damping, frictionloss with their
/// defaults and classes, the actuator's gear, mass and inertia of the body and of all that is fixed to it, by
/// inertial or by geoms, gravity on them, also where bodies are turned; files that it includes are followed;
/// a gap where a fixed tendon limits the difference of two joints, or a second joint of the body has a narrow
/// range. Of URDF: dynamics and the child's inertia. Bodies behind further joints are not followed, and no
/// mass of a mesh is read: `notes` says so.
/// @throws ConfigError where the file or one that it includes cannot be read, is of another kind, or has no
/// such joint: its joints are named
JointNumbers joint_numbers(const std::string& path, const std::string& joint);

}  // namespace gapscope
