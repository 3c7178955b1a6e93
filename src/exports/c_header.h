#pragma once

#include <vector>

#include "exports/export.h"
#include "exports/export_source.h"

namespace gapscope::internal::exports {

/// A header in C99 that moves as the simulator does.
DriveExport export_c(const ExportSource& source);

/// x1 at every sample and once more, as the code of that header makes it.
std::vector<double> c_motion(const ExportSource& source);

/// The text of drive_step.c.
const char* drive_step_text();

}  // namespace gapscope::internal::exports
