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
  Interval ci95{kNaN, kNaN};  ///< by how its stretches of a second disagree, see fit_in_loop()
};

/// A drive and its controller as whole recordings of the closed loop have them, the goal in and the position
/// out: what a user of the model sees, where the balance of torque sees row by row what acts.
struct LoopFit {
  ReferenceModel model;
  DriveController controller;
  double mae_before = kNaN, mae_after = kNaN;  ///< over the recordings that were fitted [rad]
  std::vector<std::string> added;              ///< keys of what it asked for beyond what it began with
  /// Share of the error that is left by what was added to the law of the controller itself.
  double left_by_law = 1.0;
  std::vector<LoopNumber> numbers;      ///< those that it fitted
  std::vector<HeldOutRun> fitted_runs;  ///< the recordings that were fitted beside it
};

struct LoopFitOptions {
  std::function<void(const std::string&)> progress = [](const std::string&) {};
  bool gain_is_sought = false;   ///< though it is declared: it is a beginning
  bool delay_is_sought = false;  ///< the same
  bool rate_is_sought = false;   ///< at the rows or between them
  int threads = 0;               ///< 0: all cores; the answer is the same for any number
};

/// The numbers of the model that it estimates, and those of the controller that nobody gave, where the mean
/// over the recordings of the mean absolute position error is least: Gauss-Newton on re-weighted squares,
/// from where the model stands. Beyond these, one after the other and kept where they take 2 % of the error
/// or more, at first and once all are there: what the declared controller lacks of its limit of output, a
/// profile of the goal, its filter and delay, a gain that falls with the error, a delay of the output, the
/// damping while it is switched off; dry friction, friction in proportion to the torque of the gears,
/// Stribeck friction; weight of the arm itself.
/// Where the rate is sought, the last fit has that of 200 to 2000 Hz which leaves least, with the phase of
/// each recording's turns; `added` has it where it leaves clearly less than the others. Intervals are those
/// of clustered errors: what is left is taken as alike within a second and as independent beyond, whatever
/// its law (Liang and Zeger 1986), with Student's t of as many stretches.
/// @param recordings  each with its command, from its first row on
/// @returns nothing where the motion diverges from where the model stands
std::optional<LoopFit> fit_in_loop(std::span<const MotorTrace> recordings, const ReferenceModel& model,
                                   const DriveController& controller, const LoopFitOptions& options);

/// A recording beside a model in its loop, from the first row to the last, with the phase of the controller's
/// turns that comes nearest.
HeldOutRun run_in_loop(const MotorTrace& recording, const ReferenceModel& model,
                       const DriveController& controller);

}  // namespace gapscope
