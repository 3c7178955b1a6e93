#pragma once

#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit.h"

namespace gapscope {

/// Where a recording finds a drive whose numbers are all known: the state at the first sample from which the
/// model's motion suits the recording best.
/// @param observer_hz  of the diagnosis that has fitted the model [Hz]
DriveState<double> begin_of(const ReferenceModel& model, const MotorTrace& recording, double observer_hz);

}  // namespace gapscope
