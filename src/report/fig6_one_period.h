#pragma once

#include <optional>

#include "report/report_view.h"

namespace gapscope::internal::report {

/// The passage that Fig. 6 zooms in on.
struct OnePassage {
  GapEvent event;
  double converged = kNaN;  ///< t_c: e_x is near zero from here to t1 [s]; NaN where it is not
  Interval window;          ///< [s]
};

/// Since when e_x had been quiet before t1: below a twentieth of its peak in the passage and just after it
/// [s]. NaN if it was not, or for longer than half a period.
double quiet_since(const ReportView& view, const GapEvent& event);

/// The accepted passage nearest to the median estimate; none without accepted passages.
std::optional<OnePassage> typical_passage(const ReportView& view);

}  // namespace gapscope::internal::report
