#pragma once

#include <optional>
#include <span>

#include "gapscope/reference/fit_summary.h"
#include "gapscope/sliding_mode/gap_estimate.h"

namespace gapscope {

/// The two estimates of the backlash gap side by side.
struct Comparison {
  double difference = kNaN;   ///< model-free − reference [rad]
  double joint_std = kNaN;    ///< √(σ² + σ²) [rad]
  std::optional<bool> agree;  ///< |difference| ≤ 1.96 joint_std; absent when either estimate is missing
  double true_gap = kNaN;     ///< width of the x1–x2 map where x2 was recorded [rad]
};

Comparison compare(const GapEstimate& model_free, const FitSummary& reference);

/// Full width of x1 − x2 over the recordings that carry x2: the measured reference of Fig. 3 [rad].
/// Robust against single samples and elastic wind-up. NaN without x2.
double gap_from_load_position(std::span<const Recording> recordings);

}  // namespace gapscope
