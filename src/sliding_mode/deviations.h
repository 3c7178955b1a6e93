#pragma once

#include <span>

#include "gapscope/sliding_mode/gap_estimate.h"
#include "sliding_mode/transition.h"

namespace gapscope::internal::sliding_mode {

constexpr double kFineGap = 100.0;  ///< counts in a gap from which on they do not matter

/// Of what the standard deviation of an estimate is made [rad].
struct Deviations {
  double random, directions, recordings, systematic, sampling, noise;
  double together() const;
};

/// Half of what the recordings disagree by that show the gap each by itself [rad].
/// @param fewest  passages in each direction that do
double recordings_disagreement(std::span<const Transition* const> passages, std::size_t fewest);

/// What an interval that is too wide to be told is mostly made of.
/// @param counts of the encoder in the gap
/// @param excess of the interval over the widest that is told
Remark mostly(const Deviations& deviations, double counts, double excess);

}  // namespace gapscope::internal::sliding_mode
