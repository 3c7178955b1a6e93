#pragma once

#include <algorithm>

#include "gapscope/recording/controller.h"

namespace gapscope {

/// Whether a supply multiplies what a controller asks for, which is then a duty.
inline bool is_supplied(const CommandRows& rows) {
  return std::any_of(rows.supply.begin(), rows.supply.end(), [](double v) { return v != 1.0; });
}

}  // namespace gapscope
