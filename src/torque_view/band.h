#pragma once

#include <span>
#include <vector>

#include "torque_view/model.h"

namespace gapscope::internal::torque_view {

/// What one octave of frequency says.
struct Octave {
  double top_hz = 0.0;
  double inertia = kNaN;     ///< from this octave alone, all else as fitted over the whole band
  double noise = kNaN;       ///< N/A: rms of the acceleration that is noise, over what is measured [-]
  double inertial = kNaN;    ///< share of the octave's input power that J a explains [-]
};

/// The widest band that the recordings admit: the last octave with N/A ≤ 0.3 whose J is within 10 % of those
/// below. Octaves in which J a is a small part of the input have no say about J.
struct Band {
  double hz = kNaN;
  bool free_constant = false;  ///< a recording has one speed
  std::vector<Octave> octaves;
};
Band choose_band(std::span<const StampedTrace> traces, bool rotates, const TorqueViewOptions& options);

}  // namespace gapscope::internal::torque_view
