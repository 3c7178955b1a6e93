#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "blind/drawn_law.h"
#include "config/blind_config.h"
#include "gapscope/reference/fit.h"
#include "independent_plant/severity.h"

namespace gapscope::blind {

/// A drive with effects that the diagnosis is not told, recorded on the independent plant: to be fitted,
/// held out, and a third time, never shown to the diagnosis.
struct BlindPair {
  std::string rig;
  std::string effect;  ///< "none" without, "first+second" for two
  double severity = 0.0;
  double cycles_per_turn = 1.0;  ///< of an effect along the motor angle
  std::string excitations;       ///< kinds of the three recordings, by their initials
  Recording train, held_out;
  std::function<Recording()> next;  ///< recorded when it is asked for
  ReferenceModel sheet;             ///< what the data sheet says, off by up to 20 %
  ReferenceModel truth;             ///< the same with the numbers of the drive, without effects
  std::vector<DrawnLaw> drawn;      ///< of each effect, in order
};

inline constexpr double kPairDuration = 6.0;  ///< of each recording [s]

inline constexpr const char* kRigs[] = {"paper", "geared", "heavy"};

/// Rigs: the source paper's (20 bit, 1.25 kHz); a geared axis, m2/m1 = 3, 14 bit with noise, 1 kHz; a heavy
/// load, m2/m1 = 8, small gap, 17 bit, 2 kHz. Every number but motor inertia and torque constant is off the
/// rig's by a uniform share of up to 20 %. Fitted on one kind of excitation (sine, multisine, swept
/// sine, triangle, trapezoid or steps at random), held out on another; the third is of any kind.
BlindPair blind_pair(const std::string& rig, const std::string& effect, double severity, std::uint64_t seed);

/// The same with any number of effects, each of that severity.
BlindPair blind_pair(const std::string& rig, const std::vector<std::string>& effects, double severity,
                     std::uint64_t seed, double duration = kPairDuration,
                     BlindPlant plant = BlindPlant::kIndependent);

}  // namespace gapscope::blind
