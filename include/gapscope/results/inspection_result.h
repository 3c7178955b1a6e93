#pragma once

#include <string>

#include "gapscope/inspection/inspection.h"

namespace gapscope {

/// The findings and the figures behind them as JSON (schema gapscope.check/1), units in the keys; on a
/// translational axis rad reads m. A figure that could not be had is null.
std::string inspection_json(const Inspection& inspection);

}  // namespace gapscope
