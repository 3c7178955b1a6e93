#pragma once

#include <span>

#include "gapscope/recording/units.h"

namespace gapscope {

/// How a register holds a signed number that was read as an unsigned one, by the numbers that were read, in
/// the order of their rows: two's complement, or a sign bit, where they go a far shorter way with their sign
/// than without. No form: they are as they are, or there are none of both signs.
RegisterForm seen_register(std::span<const double> numbers);

}  // namespace gapscope
