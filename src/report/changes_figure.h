#pragma once

#include "report/figure_data.h"
#include "results/drive_changes.h"

namespace gapscope::internal::report {

/// Both estimators' gap, report by report.
FigureData gap_over_recordings(const DriveChanges& changes);

}  // namespace gapscope::internal::report
