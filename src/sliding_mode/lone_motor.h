#pragma once

#include <cstddef>
#include <span>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::sliding_mode {

/// ẍ1 = drive·u − viscous·ẋ1 − dry·sign(ẋ1), of a motor that nothing else acts on. Where the torque is too
/// weak for the dry friction it stays where it came to rest.
struct LoneLaw {
  double drive = 0.0;    ///< [rad/s² per unit of u]
  double viscous = 0.0;  ///< [1/s], at least 0
  double dry = 0.0;      ///< [rad/s²], at least 0
};

/// Samples through which one motor is followed: how it arrives, comes to rest and leaves again.
struct LoneStretch {
  std::size_t first = 0, last = 0;
};

/// The squared error [rad²] that is left where one law of a lone motor is followed through all stretches,
/// each with a place and a speed of its own at its first sample: both ends of a rest are then the same place,
/// with no speed. (SharedLaw asks for neither: it gives every stretch its own, and knows no rest.) Least
/// squares by Levenberg and Marquardt over drive, friction, places and speeds, begun at two dry frictions.
/// @param start  the law of the flights
/// @returns infinity if that law is not driven
double lone_motor_squares(const MotorTrace& trace, std::span<const LoneStretch> stretches,
                          const LoneLaw& start);

}  // namespace gapscope::internal::sliding_mode
