#pragma once

#include <string>

namespace gapscope {

/// A number with so many decimals, "-0.25"; what rounds to zero has no sign: never "-0".
std::string with_decimals(double value, int decimals);

}  // namespace gapscope
