#pragma once

#include "exports/export.h"
#include "exports/export_source.h"

namespace gapscope::internal::exports {

// The drive as one joint with inertia, damping and friction, in the words of each format.
DriveExport export_urdf(const ExportSource& source);
DriveExport export_sdf(const ExportSource& source);
DriveExport export_isaac(const ExportSource& source);
DriveExport export_bam(const ExportSource& source);

}  // namespace gapscope::internal::exports
