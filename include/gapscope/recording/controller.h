#pragma once

#include <span>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// A position controller as a drive's firmware has it, of which the host commands the target. At each of its
/// updates, with e = target − position, 0 while |e| ≤ dead_band,
///   y = gain e + derivative ė + integral ∫e dt,   limited to ±saturation,
/// ė by the difference to the update before; the integral rests while y is limited. y acts `delay` later and
/// is held until the next one does.
struct PositionController {
  double gain = kNaN;             ///< [input unit/rad]
  double derivative = 0.0;        ///< [input unit s/rad]
  double integral = 0.0;          ///< [input unit/(rad s)]
  double rate = 0.0;              ///< of its updates [Hz]; 0: one at each row
  double delay = 0.0;             ///< from the reading of the position to the change of the input [s]
  double saturation = kInfinity;  ///< of y [input unit]
  double dead_band = 0.0;         ///< [rad]
};

/// What the controller made of the recorded target and position: the mean of its held output over each row's
/// interval, so that the impulse is that of the drive. Between the rows the position is taken as linear and
/// the target as held; its first update is at the first row.
/// @param t  strictly increasing, 2 or more [s]; target and position as long
std::vector<double> commanded_input(const PositionController& controller, std::span<const double> t,
                                    std::span<const double> target, std::span<const double> position);

/// What the controller's input and one that was recorded beside it have in common.
struct InputComparison {
  double scale = kNaN;  ///< recorded over commanded, by least squares [-]
  double left = kNaN;  ///< rms of recorded − scale · commanded, over that of the recorded about its mean [-]
};

InputComparison compare_inputs(std::span<const double> recorded, std::span<const double> commanded);

}  // namespace gapscope
