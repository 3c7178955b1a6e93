#pragma once

#include "changes/drive_report.h"
#include "results/drive_changes.h"

namespace gapscope::internal::changes {

/// Which numbers of the fit differ between two groups of recordings. The interval of a number holds what all
/// other numbers of its fit leave open of it, so a number whose difference is beyond chance must differ
/// whatever else does: 5 % for all numbers together that one is named that does not. The others need not.
/// What acts alike but is in neither fit may be what has changed in its place.
WhichDiffers which_differs(const DriveReport& first, const DriveReport& now);

}  // namespace gapscope::internal::changes
