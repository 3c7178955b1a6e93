#pragma once

#include <cstddef>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::sliding_mode {

/// Of the way that follows, around the turn. Of 5110001 100 gap sine wide rubs this and half read 47, of
/// which 41 hold, double 48 and 41; of 24 rigs whose load coasts this reads 20, 19 of which hold, half and
/// double 19 and 21, all but that one.
inline constexpr double kTurnWay = 0.1;

/// When a motor that does not stay turns round, to a fraction of a sample. Its dry friction changes its sign
/// there, and a sample's error of that is twice the friction's acceleration times dt in the speed of all that
/// follows. Around the turn x1 is a cubic with a step in its second derivative where its speed is zero.
/// @param first, last  samples at the extremum, within the encoder's resolution
/// @param way  how far x1 has to have moved where the stretch that is looked at ends [rad]
/// @returns samples; the middle of the stay where the stretch tells none within it
double turn_time(const MotorTrace& trace, std::size_t first, std::size_t last, double way);

struct Turn {
  double time = 0.0;  ///< [samples]
  double bend = 0.0;  ///< of the dry friction behind it (signals/motion_law.h) [rad]
};

/// The same by the law of a motor that is alone before and after it: the turn, and the bend of its dry
/// friction, by which the law holds best.
/// @param from, last  samples that it is fitted to   @param guess  known to a sample or two   @param
/// direction of x1 behind it
Turn turn_by_law(const MotorTrace& trace, std::size_t from, std::size_t last, double guess, int direction,
                 double noise);

/// Index of the largest side·x1 in [first, last], the latest of equal ones.
std::size_t farthest(const MotorTrace& trace, std::size_t first, std::size_t last, int side);

/// The turn of a stretch whose latest extreme sample is known; that sample where the stretch begins or ends
/// with it.
double turn_within(const MotorTrace& trace, std::size_t first, std::size_t latest, std::size_t last);

}  // namespace gapscope::internal::sliding_mode
