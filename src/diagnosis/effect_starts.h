#pragma once

#include <vector>

#include "gapscope/plant/effect.h"

namespace gapscope::internal::diagnosis {

/// The effect's own starts; for one that has none a tenth of its upper bounds.
std::vector<EffectStart> effect_starts(const EffectEntry& entry);

}  // namespace gapscope::internal::diagnosis
