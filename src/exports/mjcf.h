#pragma once

#include "exports/export.h"
#include "exports/export_source.h"

namespace gapscope::internal::exports {

/// A model that stands alone, a fragment for a model of the user's own, and what both can say.
DriveExport export_mjcf(const ExportSource& source);

}  // namespace gapscope::internal::exports
