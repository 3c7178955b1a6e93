#pragma once

#include <string>

#include "gapscope/diagnosis/simulator.h"

namespace gapscope::internal::diagnosis {

/// "it has 0.02 N m of motor coulomb friction where the drive has 0.05 N m"
/// @param rows all of the table: what a solver leaves in one shows beside another
/// @param dt   sampling interval, in which a delay is told too [s]
std::string row_sentence(const SimulatorRow& row, const std::vector<SimulatorRow>& rows, double dt,
                         Coordinates coordinates);

/// The whole in a few sentences.
std::string comparison_sentence(const SimulatorComparison& comparison, Coordinates coordinates);

}  // namespace gapscope::internal::diagnosis
