#pragma once

#include "reference/fit_problem.h"

namespace gapscope::internal::reference {

/// Gives the recordings the inputs that the controller makes of their targets at its start, and the problem
/// that controller. A leading number without a value is the one at which what the model knows in units of
/// torque or inertia, see torque_scale(), moves as recorded; else the one at which the largest input is 1.
/// @throws std::logic_error for a recording without a command
void command_inputs(FitProblem& problem, const ReferenceModel& model);

/// The numbers of the controller behind those of the drive. Bounds that are not given: a leading number
/// within a hundred times of its start, the others from 0 on, a delay to 50 samples.
void add_controller(FitProblem& problem, const ControllerModel& model);

}  // namespace gapscope::internal::reference
