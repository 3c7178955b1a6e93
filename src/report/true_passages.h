#pragma once

#include <vector>

#include "report/report_view.h"

namespace gapscope::internal::report {

/// A passage of the gap as the simulated plant had it, of which no estimator knows.
struct TruePassage {
  double released = kNaN;                       ///< the last contact with one flank is over [s]
  double impact = kNaN;                         ///< the first with the other one [s]
  double x1_released = kNaN, x1_impact = kNaN;  ///< [rad]
};

/// Those that end within the interval, in time; none of a recorded drive. To the sample.
std::vector<TruePassage> true_passages(const ReportView& view, const Interval& interval);

inline constexpr const char* kTrueRelease = "true release";
inline constexpr const char* kTrueImpact = "true impact";

}  // namespace gapscope::internal::report
