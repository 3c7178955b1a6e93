#pragma once

#include <span>
#include <vector>

#include "torque_view/model.h"

namespace gapscope::internal::torque_view {

/// What one half octave of frequency says.
struct Octave {
  double top_hz = 0.0;
  double inertia = kNaN;      ///< from this octave alone, all else as fitted over the whole band
  double inertia_std = kNaN;  ///< what the rest of the torque leaves it open by
  double noise = kNaN;        ///< N/A: rms of the acceleration that is noise, over what is measured [-]
  double inertial = kNaN;     ///< power of J a over that of the input [-]
  double power = kNaN;        ///< mean square acceleration [rad²/s⁴]
};

/// The widest band that the recordings admit: the last half octave with N/A ≤ 0.2 whose J is not less than
/// 0.9 of those below, by more than what else the octave holds lets it vary. Noise of the encoder only ever
/// takes from J (1 − N²/A²), and more the higher the octave: one that is larger ends nothing, and neither
/// does a low one above which J comes back, as a torque that the model lacks makes it. Where J a is a small
/// part of the input an octave has no say about J. A line that repeats with the position is in the model that
/// reads J: as a torque that is missing it would pass for another J in the octave in which it passes.
struct FrequencyBand {
  double hz = kNaN;
  bool free_constant = false;  ///< a recording has one speed
  std::vector<Octave> octaves;
};
/// @param known  turns, whether the output is held, and cycles per 2π of what is known to repeat
FrequencyBand choose_band(std::span<const StampedTrace> traces, const Scales& known,
                          const TorqueViewOptions& options, int threads = 1);

}  // namespace gapscope::internal::torque_view
