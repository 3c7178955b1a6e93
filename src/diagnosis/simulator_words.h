#pragma once

#include <string>

#include "gapscope/diagnosis/simulator.h"

namespace gapscope::internal::diagnosis {

/// "it has 0.02 N m of motor coulomb friction where the drive has 0.05 N m"
/// @param rows all of the table: what a solver leaves in one shows beside another
/// @param dt   sampling interval, in which a delay is told too [s]
std::string row_sentence(const SimulatorRow& row, const std::vector<SimulatorRow>& rows, double dt,
                         Coordinates coordinates);

/// The whole in a few sentences. Where no row differs, but the model leaves a side more than a row would have
/// to show, or the simulator is off the drive by that much, what differs is not told.
/// @param drive_floors, simulator_floors  what the model with all effects of both leaves on either [floor]
std::string sentence_beside(const SimulatorComparison& comparison, double drive_floors,
                            double simulator_floors, Coordinates coordinates);

}  // namespace gapscope::internal::diagnosis
