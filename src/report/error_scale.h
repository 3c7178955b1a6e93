#pragma once

#include "report/report_view.h"

namespace gapscope::internal::report {

/// The factor N of step S2 that makes e_x comparable with a signal of the given size [rad]: the detector's
/// own where that shows e_x well beside it, else a round one.
double error_factor(const ReportView& view, const Interval& interval, double target);

/// N·e_x over an interval, labelled with its factor.
Series scaled_error(const ReportView& view, const Interval& interval, double target);

}  // namespace gapscope::internal::report
