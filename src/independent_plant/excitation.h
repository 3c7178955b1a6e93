#pragma once

#include <cstdint>
#include <vector>

namespace gapscope::independent_plant {

enum class Waveform {
  kSine,
  kMultisine,  ///< `lines` frequencies evenly spaced from frequency to frequency_end, random phases
  kSweptSine,  ///< frequency to frequency_end over the duration, linearly in time
  kTriangle,
  kTrapezoid,  ///< ramp, hold and dwell at zero by turns
  kSteps,      ///< random levels, each held for a random time around 1/frequency
};

struct BlindExcitation {
  Waveform waveform = Waveform::kSine;
  double amplitude = 0.5814;   ///< peak [unit of u]
  double frequency = 1.0;      ///< [Hz]
  double frequency_end = 5.0;  ///< multisine, swept sine [Hz]
  int lines = 8;               ///< multisine
  double dwell = 0.25;         ///< trapezoid: share of a half period spent at zero
  double hold = 0.25;          ///< trapezoid: share of a half period spent at the amplitude
  double offset = 0.0;         ///< [unit of u]
};

/// The command at the samples k/rate, each held to the next.
std::vector<double> command(const BlindExcitation& excitation, double rate, double duration,
                            std::uint64_t seed);

}  // namespace gapscope::independent_plant
