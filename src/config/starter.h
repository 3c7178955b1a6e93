#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/data_config.h"
#include "config/joint_numbers.h"
#include "config/model_config.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

/// What kind of drive a configuration describes.
enum class StarterModel { kAsSeen, kGap, kLocked, kOneBody };

/// A first configuration for a recording of which nothing else is known.
struct Starter {
  std::string yaml;                   ///< run, fit, detect and diagnose accept it as it is
  bool guesses = false;               ///< a number in it is marked GUESS
  std::string model;                  ///< which structure was chosen, and why
  std::vector<std::string> remarks;   ///< what of a simulator's model was left aside, or is doubtful
  std::vector<Remark> assumed = {};   ///< how the recording was read, where nobody declared it
  std::vector<std::string> spoiling;  ///< what `check` says will spoil the estimates
  std::string hangs;  ///< where the arm of an anchor hangs, as the recording shows it; empty: taken as 0
  std::string order;  ///< which of two recordings is better fitted, and why; empty where there is one
};

/// What is known of the drive beside its recording.
struct StarterKnowledge {
  StarterModel model = StarterModel::kAsSeen;  ///< kAsSeen: the detector decides
  /// What a simulator's model says: the fit begins with its numbers. Its gap, or the detector's where it has
  /// none, decides the structure where nobody asks for another.
  std::optional<JointNumbers> nominal = {};
  /// What fixes the scale of the torques: torque_constant is then left to the fit, and with it every number
  /// that was read in units of u.
  std::optional<AnchorConfig> anchor = {};
  /// The sheet's, of the motor, before a gear [N m or N per unit of u]; NaN: not known.
  double torque_constant = kNaN;
  double motor_inertia = kNaN;  ///< beside torque_constant, the sheet's as well [kg m²; of a slide kg]
  std::string name = {};        ///< that its report shall have; empty: the joint's, or the recording's
  std::string options = {};     ///< of the command beside its recordings, for one that Starter::order tells
  bool gain_sought = false;     ///< of the controller that makes the input of the target: the fit finds it
};

/// Reads off a recording what it tells (columns, a rate for the detector, encoder, whether there is a gap, a
/// locked output or one body, and of one body the first numbers) and marks the rest as GUESS or leaves it to
/// the fit. Torques are in units of u until torque_constant or an anchor is given; gaps do not depend on it.
/// @param recording  one file, and at most one that is held out
/// @param encoder what is known of it; else the step that is seen
/// @param folder  where the configuration will be: the recording is named relative to it
/// @throws ConfigError where a recording cannot be read, or a torque constant is told of an input that is a
///   torque, or of a controller whose gain takes its place
Starter starter_configuration(RecordingConfig recording, const EncoderConfig& encoder,
                              Coordinates coordinates, const std::string& folder,
                              const StarterKnowledge& known = {});

}  // namespace gapscope
