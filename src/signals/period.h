#pragma once

#include <cstddef>
#include <span>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// v at i samples, linear between them; beyond the last one as there.
inline double between_samples(std::span<const double> v, double i) {
  const auto k = static_cast<std::size_t>(i);
  if (k + 1 >= v.size()) return v.back();
  const double share = i - static_cast<double>(k);
  return (1.0 - share) * v[k] + share * v[k + 1];
}

/// The period of an input that repeats itself exactly, as a command does: between the samples, so that
/// periods can be laid on each other. From the lag, many periods long, at which u comes back within 0.1 % of
/// its variance [s]; 0 if it does not, or fewer than `fewest` times.
double exact_period(const MotorTrace& trace, double fewest);

/// The period of an input that repeats itself roughly, as a measured torque does: the first whole number of
/// samples after which u comes back within 15 % of its rms [samples]; 0 if it does not at least twice, or
/// where samples are no measure of time: they are uneven.
std::size_t rough_period(const MotorTrace& trace);

/// The exact period where there is one that comes back twice, else the rough one [samples]; 0: none.
double input_period(const MotorTrace& trace);

/// What of v does not come back after a lag [samples], linear between them: rms of v(t + lag) − v(t) from a
/// sample on, over √2.
double repetition_error(std::span<const double> v, std::size_t from, double lag);

}  // namespace gapscope::internal::signals
