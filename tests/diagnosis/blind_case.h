#pragma once

#include <cstdint>
#include <string>

#include "blind/plant/severity.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::test {

/// A drive with an effect that the diagnosis is not told, recorded twice on the independent plant.
struct BlindPair {
  std::string rig;
  std::string effect;  ///< "none" without
  double severity = 0.0;
  Recording train, held_out;
  ReferenceModel sheet;  ///< what the data sheet says, off by up to 20 %
};

inline constexpr const char* kRigs[] = {"paper", "geared", "heavy"};

/// Rigs: the source paper's (20 bit, 1.25 kHz); a geared axis, m2/m1 = 3, 14 bit with noise, 1 kHz; a heavy
/// load, m2/m1 = 8, small gap, 17 bit, 2 kHz. Every number but motor inertia and torque constant is off the
/// rig's by a uniform share of up to 20 %. 6 s each, fitted on one kind of excitation, held out on another.
/// `none` cases begin with swept sines and bouncing.
BlindPair blind_pair(const std::string& rig, const std::string& effect, double severity, std::uint64_t seed);

}  // namespace gapscope::test
