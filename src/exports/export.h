#pragma once

#include <optional>

#include "config/configuration.h"
#include "config/joint_numbers.h"
#include "gapscope/exports/export_drive.h"

namespace gapscope {

/// The same of a configuration that was read already.
/// @param own  of the MJCF that has the joint already: the certificate of mjcf then tells the numbers for it
DriveExport export_drive(const Configuration& configuration, ExportFormat format,
                         const std::optional<JointNumbers>& own = {});

}  // namespace gapscope
