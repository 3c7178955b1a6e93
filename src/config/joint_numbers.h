#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/controller.h"

namespace gapscope {

/// The body that gravity turns about a hinge, as its file has it: what it takes to say where its centre
/// belongs for another gravity.
struct HangingBody {
  std::string name;                            ///< "body forearm"
  double mass = 0.0;                           ///< its own, without bodies that are fixed to it [kg]
  double weighed = 0.0;                        ///< of it what gravcomp does not hold [kg]
  bool by_geoms = false;                       ///< the mass is that of its geoms, and no inertial's
  std::array<double, 3> centre{};              ///< of that mass, in the body's frame [m]
  std::array<double, 6> inertia{};             ///< about it: xx yy zz xy xz yz [kg m²]
  std::array<double, 3> down{}, aside{};       ///< unit vectors across the axis: gravity's way, axis × down
  double lever_down = 0.0, lever_aside = 0.0;  ///< of the centre from the axis along both [m]
  double gravity = 0.0;                        ///< across the axis [m/s²]
  double reference = 0.0;                      ///< `ref` of the joint [rad]
};

/// What a simulator's model says of one joint's drive; NaN: nothing.
struct JointNumbers {
  std::string model, joint;    ///< the file and the name in it
  bool of_mjcf = false;        ///< and no URDF
  std::string body_place;      ///< pos= and turn of the joint's body, as attributes behind a blank; of MJCF
  std::string axis_place;      ///< axis= of the joint, and its pos=, as attributes; of MJCF
  bool slides = false;         ///< rad reads m, N m reads N
  double inertia = kNaN;       ///< of the motor's side, or of all that turns [kg m²]
  double body_inertia = kNaN;  ///< of it, the body's own, without the armature; of MJCF [kg m²]
  double damping = kNaN;       ///< [N m s/rad]
  double friction = kNaN;      ///< dry, on the motor's side [N m]
  double torque_constant = kNaN;  ///< [N m per unit of the control]
  double unbalance = kNaN;  ///< gravity's torque −G sin(x + phase), on the load where there is one [N m]
  double unbalance_phase = 0.0;          ///< [rad]
  std::optional<HangingBody> hanging;    ///< what has that torque, or would; nothing: not known
  double constant_torque = 0.0;          ///< on the motor's side: an actuator's bias, a slide's weight [N m]
  double load_constant_torque = 0.0;     ///< the same on the load [N m]
  double weight = 0.0;                   ///< of either what gravity has, along a slide [N]
  double lag = 0.0;                      ///< time constant of the actuator's filter [s]; 0: none
  double input_limit = kInfinity;        ///< of the control, either way
  std::optional<DriveController> servo;  ///< that the control is the goal of, then u is its torque; of MJCF
  double gap = kNaN;                     ///< [rad]; the numbers below belong to it
  bool locked = false;                   ///< its other side is the ground
  std::string load_joint;                ///< the name of the load's; empty: it has none of its own
  double load_body_inertia = kNaN;       ///< as body_inertia [kg m²]
  double load_inertia = kNaN;            ///< [kg m²]
  double load_damping = kNaN;            ///< [N m s/rad]
  double load_friction = kNaN;           ///< [N m]
  double stiffness = kNaN;               ///< of the contact [N m/rad]
  double contact_damping = kNaN;         ///< [N m s/rad]
  std::vector<std::string> notes;        ///< what was left aside, as sentences
};

/// Reads a joint of an MJCF (`mujoco`) or URDF (`robot`). Of MJCF: armature, damping, frictionloss with their
/// defaults and classes, the actuator's gear, mass and inertia of the body and of all that is fixed to it, by
/// inertial or by geoms, gravity on them, also where bodies are turned, the actuator's bias, filter and
/// range; files that it includes are followed; a gap where a fixed tendon limits the difference of two
/// joints, or confines a single joint to a narrow range, or a second joint of the body has a narrow range. Of
/// URDF: dynamics and the child's inertia. Bodies behind further joints are not followed, and no mass of a
/// mesh is read: `notes` says so.
/// @throws ConfigError where the file or one that it includes cannot be read, is of another kind, or has no
/// such joint: its joints are named
JointNumbers joint_numbers(const std::string& path, const std::string& joint);

}  // namespace gapscope
