#pragma once

#include <optional>
#include <span>

#include "gapscope/reference/fit_summary.h"
#include "gapscope/sliding_mode/gap_estimate.h"

namespace gapscope {

/// The two estimates of the backlash gap side by side. A rejected reference is no number to compare with:
/// it counts as missing.
struct Comparison {
  double difference = kNaN;   ///< model-free − reference [rad]
  double joint_std = kNaN;    ///< √(σ² + σ²) [rad]
  std::optional<bool> agree;  ///< |difference| ≤ kNormal95 joint_std; absent when either estimate is missing
  double map_width = kNaN;    ///< see map_width(); NaN without x2 [rad]
};

Comparison compare(const GapEstimate& model_free, const FitSummary& reference);

/// A fitted model that is not rejected and asks for a gap that is larger than what single impacts read, by
/// more than either interval and a trusted reading's half width leave open: what they read is the first of
/// several gaps, or a load that moved. The reading becomes one of kFirstGap, with limited trust.
void take_for_first_gap(const FitSummary& reference, GapEstimate& model_free);

/// The x1–x2 map of Fig. 3 from flank to flank, over the recordings that carry x2 [rad]: the distance of the
/// medians of both flanks. Single samples and ringing do not matter; the elastic wind-up of a loaded contact
/// is in it, so that it reads a little more than the gap. NaN without x2.
double map_width(std::span<const Recording> recordings);

}  // namespace gapscope
