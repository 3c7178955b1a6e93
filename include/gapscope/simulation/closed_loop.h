#pragma once

#include <span>

#include "gapscope/recording/controller.h"
#include "gapscope/simulation/simulate.h"

namespace gapscope {

/// The drive under a controller that reads its encoder: an update takes the reading of its own moment, its
/// output acts `delay` later, and the drive moves exactly from one of these moments to the next. u is the
/// mean of what acted in each interval, `command` what it was made of.
/// @param target  held from sample to sample [rad], of a controller of the speed [rad/s]
/// @param supply  that multiplies what the controller asks for, of each sample [V]; empty: nothing does
/// @throws std::runtime_error when the motion diverges.
Recording simulate_under_controller(const PlantModel<double>& model, const DriveController& controller,
                                    std::span<const double> target, const SimulationOptions& options,
                                    std::span<const double> supply = {});

/// The same beside a recording that has a command: from its first row on the model follows its targets, under
/// its supply and without the encoder's noise and resolution. Nothing of the recorded position comes in
/// later.
/// @param controller  as it is declared: the recording says by how much its gain was another
/// @param start       of the drive, at the first row
/// @param phase       share of a turn of the controller by which its first update comes after the first row
/// @returns the position that the encoder would read at each row [rad]; empty where the motion diverges
std::vector<double> positions_under_controller(const PlantModel<double>& model,
                                               const DriveController& controller, const MotorTrace& recording,
                                               const DriveState<double>& start, double phase = 0.0);

}  // namespace gapscope
