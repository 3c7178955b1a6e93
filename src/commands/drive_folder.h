#pragma once

#include <string>

#include "config/configuration.h"
#include "results/report_folder.h"

namespace gapscope {

/// The folder for the report of a configuration, taken before the work: an earlier report there must be of
/// one of its recordings, or of the simulation of its name.
/// @throws ConfigError as ReportFolder
ReportFolder drive_folder(const std::string& folder, const Configuration& configuration);

}  // namespace gapscope
