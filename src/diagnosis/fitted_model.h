#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/held_out.h"
#include "diagnosis/rule.h"

namespace gapscope::internal::diagnosis {

/// A number on which the torque alone and the free run disagree, beyond the interval of the former.
struct Disagreement {
  reference::ParameterId id;
  double by_torque = kNaN, by_run = kNaN;
};

/// A model fitted to the training recordings, and the state that each of them begins with.
struct FittedModel {
  ReferenceModel model;
  std::vector<reference::RecordingStart> starts;
  double mean_cost = kInfinity;       ///< what it leaves, see reference::RefinedFit [floor²]
  std::vector<std::string> at_bound;  ///< keys of the last effect's parameters that ended at a bound
  std::array<BoundReached, kDriveParameterCount> drive_at_bound = {};  ///< of the drive's parameters
  /// Its numbers are those of the torque balance, which no fit to the motion has moved.
  bool balanced = false;
  std::optional<reference::StandardErrors> errors = {};  ///< once it is settled, see settle.h
  std::vector<Disagreement> disagreements = {};  ///< of one that was fitted for its runs, see long_runs.h
  bool searched = false;  ///< from afar with its effects as they are: that has led nowhere else
};

/// The model where a refinement has led; infinite if that failed.
FittedModel fitted_at(const reference::ModelFit& fit, const reference::RefinedFit& best);

/// Mean square of a fit at the floor [floor²]: no other start can be better.
inline constexpr double kExplained = kRule.floor_ratio * kRule.floor_ratio;

/// The nominal model, from the given values and, where needed, others.
FittedModel fit_nominal(std::span<const MotorTrace> train, const ReferenceModel& model,
                        const FitOptions& options, double observer_hz);

/// The nominal model from the values of a fit to other recordings, and nowhere else.
FittedModel fit_near(std::span<const MotorTrace> recordings, const ReferenceModel& from,
                     const FitOptions& options, double observer_hz,
                     const reference::RefineEffort& effort = {});

/// A model with the values of another drive, its controller's among them: its own effects stay.
ReferenceModel with_drive(ReferenceModel model, const ReferenceModel& drive);

}  // namespace gapscope::internal::diagnosis
