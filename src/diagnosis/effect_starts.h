#pragma once

#include <array>
#include <vector>

#include "gapscope/plant/effect.h"

namespace gapscope::internal::diagnosis {

/// Parameters of an effect at which its search begins, in units of their scales; NaN: found from the residual
/// torque.
using EffectStart = std::array<double, kMostEffectParameters>;

/// Several magnitudes and, where the effect has one, phases: what is absent has no slope, and what is far off
/// ends in another minimum. For an effect without a row of its own: a tenth of its upper bounds.
std::vector<EffectStart> effect_starts(const EffectEntry& entry);

/// The simpler effect that this one contains, whose fit is one of its starts; nullptr if there is none.
const EffectEntry* nested_parent(const EffectEntry& entry);

/// Whether the law has no shape that could be another than the real one's, just a size: where it is the cause
/// it leaves nothing.
bool law_is_fixed(const EffectEntry& entry);

}  // namespace gapscope::internal::diagnosis
