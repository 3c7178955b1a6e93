#pragma once

#include <string>
#include <vector>

#include "diagnosis/held_out.h"

namespace gapscope::internal::diagnosis {

/// What a drive that is driven alike leaves of an error that a model could explain: its rms difference from
/// one period to the next, over √2 (the model's own error, however large, is the same in both).
struct Repeatability {
  double innovation = kNaN, free = kNaN;  ///< [rad]; NaN: no recording repeats its input
  bool stationary = true;                 ///< periods two apart differ no more than neighbours do
  std::string read_from;                  ///< "3.9 periods of 6.24 s in run.csv"
};

/// @param playbacks of one model; restarts are those of held_out
Repeatability repeatability_of(const std::vector<Playback>& playbacks, const HeldOut& held_out);

/// Adds to the floors what half a step of a supply's readings moves: a servo that tells its voltage in steps
/// of a percent leaves its torque open by as much, and no model can come closer. It is the rms difference of
/// the innovations and the free runs of `model` between the input as it is read and as it may have been: half
/// a step more or less, drawn anew with each change of the reading. Nothing where no supply is told.
/// @returns whether there is any
bool add_supply_steps(const ReferenceModel& model, double observer_hz, HeldOut& held_out);

}  // namespace gapscope::internal::diagnosis
