#pragma once

#include <cmath>

#include "implant/implant_law.h"

/// What laws of several ways draw alike.
namespace gapscope::internal::implant {

inline constexpr ValueName kUnused{"", ""};
inline constexpr int kPointsOfStep = 8;  ///< at which what changes within a step is read

inline void draw_nothing(Values&, const CaseScale&, const Receiver&, std::mt19937_64&) {}

inline void draw_phase(Values& v, const CaseScale&, const Receiver&, std::mt19937_64& g) {
  v[1] = uniform(g, 0.0, 2.0 * kPi);
}

/// A period between a quarter of the travel and what passes 20 Hz at the rms speed.
inline void draw_line(Values& v, const CaseScale& s, const Receiver&, std::mt19937_64& g) {
  constexpr double kFewest = 4.0, kTopHz = 20.0;
  const double longest = s.travel / kFewest, shortest = std::min(s.rms_speed / kTopHz, longest);
  v[1] = 2.0 * kPi / log_uniform(g, shortest, longest);
  v[2] = uniform(g, 0.0, 2.0 * kPi);
}

/// A sine that is steeper on one side of a tooth than on the other.
inline double skewed_sine(double angle) {
  constexpr double kSkew = 0.2;  // [rad]
  return std::sin(angle + kSkew * std::sin(angle));
}

}  // namespace gapscope::internal::implant
