#pragma once

#include <string>

#include "gapscope/base/coordinates.h"

namespace gapscope::internal::campaign {

/// What a parameter is called and measured in, for people.
struct AxisName {
  std::string name;  ///< "sampling rate"; the path itself where there is no better one
  std::string unit;  ///< "Hz"; "" without
};
AxisName axis_name(const std::string& path, Coordinates coordinates);

/// "2 kHz", "19 mrad", "0.3", "16 bit"
std::string with_unit(double value, const std::string& unit);

}  // namespace gapscope::internal::campaign
