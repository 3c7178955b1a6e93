#pragma once

#include <span>

#include "gapscope/recording/units.h"

namespace gapscope {

/// How a register holds a signed number that was read as an unsigned one, by the numbers that were read:
/// two's complement where they are small or just below 2^bits, a sign bit where they are small with and
/// without it, nothing in between. No form: they are as they are, or there are none of both signs.
RegisterForm seen_register(std::span<const double> numbers);

}  // namespace gapscope
