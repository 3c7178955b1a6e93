#pragma once

#include <span>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit_summary.h"

namespace gapscope {

/// `encoder: {side: both}` – what the encoder on the load says of a model that was fitted to the motor's
/// alone. The two have no common zero: of each recording the mean difference is taken out.
struct SecondEncoder {
  double rmse = kNaN;         ///< free-run x2 − recorded x2 [rad]; NaN without a fit that runs, or a load
  double motor_rmse = kNaN;   ///< the same of x1, which was fitted [rad]
  double fit_percent = kNaN;  ///< 100 (1 − |x2 − x̂2|/|x2 − mean|), worst recording
  double floor = kNaN;        ///< what this encoder alone leaves [rad]
  double gap = kNaN;          ///< from flank to flank of x1 − x2, see map_width() [rad]
  double difference = kNaN;   ///< the reference's gap − this one [rad]; NaN without
};

/// @param recordings  with x1 and x2; of others nothing can be told
/// @param reference   null: not fitted
SecondEncoder validate_by_load(std::span<const Recording> recordings, const FitSummary* reference);

}  // namespace gapscope
