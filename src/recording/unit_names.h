#pragma once

#include <string>
#include <vector>

#include "gapscope/recording/units.h"

namespace gapscope {

/// What unit_scale() knows by name, but for the other ways to write the sign in a torque's unit.
std::vector<std::string> unit_names(Quantity quantity);

}  // namespace gapscope
