#pragma once

#include <span>

#include "gapscope/plant/effect.h"

namespace gapscope {

/// Other laws of contact and friction that a fit holds against its own: no cause is named after them, and no
/// configuration has them.
std::span<const EffectEntry* const> rival_law_table();

}  // namespace gapscope
