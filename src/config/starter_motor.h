#pragma once

#include <string>

#include "config/joint_numbers.h"
#include "config/model_config.h"
#include "config/starter.h"
#include "config/yaml_writer.h"

/// What a first configuration says of the motor, and of the scale of its torques.
namespace gapscope::internal::config {

/// Where a fit begins: with the numbers of a simulator's model, of the recording read as one body, or
/// without.
struct Begin {
  JointNumbers numbers;
  std::string from;              ///< "read, as one body"
  double asymmetry = 0.0;        ///< of the motor's friction, forward [-]
  double largest_input = 0.0;    ///< of the recordings [unit of u]
  bool geared = false;           ///< x1 is behind a gear, and a sheet's numbers are of the motor before it
  bool input_is_torque = false;  ///< torque_constant is 1, and no guess
  bool nominal = false;          ///< the numbers are a simulator's
  double motor_constant = kNaN;  ///< told: torque_constant before the gear [N m or N per unit of u]
  double motor_inertia = kNaN;   ///< told with it: before the gear, too [kg m² or kg]
  bool one_body = false;         ///< whose inertia is that of all that moves
  bool knows_inertia = false;    ///< by the anchor, or that it is a mass and no less
  bool gain_sought = false;      ///< of the controller, which takes the size of the torque constant
  bool friction_sought = false;  ///< of the motor: two bodies of which no sheet tells it
  bool anchored = false;  ///< the torque constant is left to the fit, and all that was read in units of u

  bool settled() const { return input_is_torque || anchored || numbers.torque_constant > 0.0; }
};

/// Takes the torque constant of the sheet, and what was read over it in proportion.
/// @param ratio  turns of the motor for one of the axis
/// @throws ConfigError where the input is a torque, or a gain that is sought takes the constant's place
void take_constant(Begin& begin, double constant, double ratio);

/// {value: ..., estimate: true} with a number that is known, else without.
void write_estimated(YamlWriter& out, const char* key, double value, const std::string& unit,
                     const Begin& begin);

/// Torque constant, inertia and damping.
void write_motor(YamlWriter& out, const Begin& begin, Coordinates coordinates);

/// Leaves what the structure has no place for to the notes, and finds the effects that are a model's constant
/// torques: on the load constant_load_torque, before a gap the difference of the motor's friction between
/// both directions.
void fit_to_structure(Begin& begin, StarterModel structure);

/// An input far beyond the range of a geared actuator's control is likely the torque behind the gear: a note
/// says so.
void doubt_the_control(Begin& begin, Coordinates coordinates);

/// Friction, gravity, constant torques, filter and range of the actuator, where they were read, and the
/// friction that is sought: a diagnosis then begins with what is missing beside them. A range that the input
/// does not exceed is none of them.
void write_effects(YamlWriter& out, const Begin& begin, Coordinates coordinates);

/// "{mass: 0.49, arm: 0.1}"; with an arm that hangs clearly elsewhere than at 0: "hangs_at: {value: 3.14,
/// ...}".
/// @param hangs_at  as the recording shows it [rad]; NaN: it does not
std::string anchor_text(const AnchorConfig& anchor, double hangs_at = kNaN);

/// What stands beside it, and in what is told of it: where the arm hangs, or that it is taken as 0.
std::string anchor_comment(const AnchorConfig& anchor, double hangs_at);

/// "hangs at 3.14 rad, ..."; empty: within what is looked about 0, or not seen.
std::string hanging_told(const AnchorConfig& anchor, double hangs_at);

/// Where torque_constant is a guess: one number with a unit of torque settles it.
void suggest_anchor(YamlWriter& out, bool gain_sought, Coordinates coordinates);

}  // namespace gapscope::internal::config
