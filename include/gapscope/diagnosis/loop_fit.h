#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/diagnosis/whole_run.h"
#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit.h"

namespace gapscope {

/// One number of a drive in its loop.
struct LoopNumber {
  std::string key;  ///< as in the YAML: "controller.position.falls_at", "motor_inertia", "effect.parameter"
  std::string unit;
  double value = kNaN;
};

/// A drive and its controller as whole recordings of the closed loop have them, the goal in and the position
/// out: what a user of the model sees, where the balance of torque sees row by row what acts.
struct LoopFit {
  ReferenceModel model;
  DriveController controller;
  double mae_before = kNaN, mae_after = kNaN;  ///< over the recordings that were fitted [rad]
  std::vector<std::string> added;              ///< keys of what it asked for beyond what it began with
  /// Share of the error that what was added to the law of the controller itself left, when it was added.
  double left_by_law = 1.0;
  std::vector<LoopNumber> numbers;      ///< those that it fitted
  std::vector<HeldOutRun> fitted_runs;  ///< the recordings that were fitted beside it
};

struct LoopFitOptions {
  std::function<void(const std::string&)> progress = [](const std::string&) {};
  bool gain_is_sought = false;  ///< the leading number is none of the user's
  bool delay_is_sought = true;  ///< the same
  bool saturation_is_sought = true;
  bool fall_is_sought = true;  ///< of the gain with the error
  bool off_damping_is_sought = true;
  bool goal_delay_is_sought = true;
  bool rate_is_sought = false;  ///< at the rows or between them
  int threads = 0;              ///< 0: all cores; the answer is the same for any number
};

/// The numbers of the model that it estimates, and those of the controller that nobody gave, where the mean
/// over the recordings of the mean absolute position error is least: Gauss-Newton on re-weighted squares,
/// from where the model stands. Beyond these, one after the other and kept where they take 2 % of the error
/// or more: the controller's limit of output, a gain that falls with the error, its delay, the damping while
/// it is switched off; dry friction, friction in proportion to the torque of the gears, Stribeck friction;
/// weight of the arm itself.
/// @param recordings  each with its command, from its first row on
/// @returns nothing where the motion diverges from where the model stands
std::optional<LoopFit> fit_in_loop(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                                   const DriveController& controller, const LoopFitOptions& options);

/// A recording beside a model in its loop, from the first row to the last.
HeldOutRun run_in_loop(const MotorTrace& recording, const ReferenceModel& model,
                       const DriveController& controller);

}  // namespace gapscope
