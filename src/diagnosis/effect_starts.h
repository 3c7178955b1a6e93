#pragma once

#include <vector>

#include "gapscope/reference/fit.h"

namespace gapscope::internal::diagnosis {

/// The effect's own starts; for one that has none a tenth of its upper bounds.
std::vector<EffectStart> effect_starts(const EffectEntry& entry);

/// The effect with these values, to be estimated; what a search leaves alone is fixed where it has its
/// neutral value, and where it has none.
/// @param values in the order of the specification; NaN: not known
ModelEffect searched_effect(const EffectEntry& entry, const std::vector<double>& values,
                            const ShaftTurns& turns);
/// The same with nothing known.
ModelEffect searched_effect(const EffectEntry& entry, const ShaftTurns& turns);

}  // namespace gapscope::internal::diagnosis
