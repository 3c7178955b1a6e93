#pragma once

#include <span>
#include <string>
#include <vector>

#include "changes/drive_report.h"

namespace gapscope::internal::changes {

/// Why the numbers of these reports may differ although the drive does not: other numbers were given, other
/// recordings made, another method read, a model that does not explain what it was fitted to.
std::vector<std::string> differences_of_making(std::span<const DriveReport> reports);

}  // namespace gapscope::internal::changes
