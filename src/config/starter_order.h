#pragma once

#include <string>

#include "config/data_config.h"
#include "gapscope/base/coordinates.h"

namespace gapscope::internal::config {

/// Which of the first recording and the first that is held out is better fitted, and why: both are read as
/// diagnose would. Where they are better turned round it ends with the command that does so.
/// @param options  of that command beside the recordings
/// @throws ConfigError where a recording cannot be read
std::string order_told(const RecordingConfig& recording, const std::string& options, Coordinates coordinates);

}  // namespace gapscope::internal::config
