#pragma once

#include <string>

#include "gapscope/inspection/inspection.h"

namespace gapscope {

/// The findings and the figures behind them as JSON (schema gapscope.check/1), units in the keys; on a
/// translational axis rad reads m. A figure that could not be had is null.
/// @param configuration  resolved_reading() of the recording, which is stored with its SHA-256
std::string inspection_json(const Inspection& inspection, const std::string& configuration);

/// Whether a file holds what inspection_json() gives.
bool is_inspection_file(const std::string& path);

}  // namespace gapscope
