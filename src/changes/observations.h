#pragma once

#include <span>
#include <vector>

#include "changes/drive_report.h"
#include "results/drive_changes.h"

namespace gapscope::internal::changes {

/// Every quantity that at least one report tells, with what each says of it; what matters most first: the
/// gap, the lost motion by torque level, the loop, the numbers of the fit, what a diagnosis has found.
/// Without changes.
std::vector<DriveQuantity> observed_quantities(std::span<const DriveReport> reports);

/// Whether ramps to these largest |u| are of one level.
bool same_level(double a, double b);

}  // namespace gapscope::internal::changes
