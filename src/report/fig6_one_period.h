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

/// The accepted passage nearest to the median estimate; none without accepted passages.
std::optional<OnePassage> typical_passage(const ReportView& view);

}  // namespace gapscope::internal::report
