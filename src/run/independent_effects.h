#pragma once

#include <vector>

#include "config/model_config.h"
#include "independent_plant/effects.h"

namespace gapscope::internal::run {

/// Effects of the catalogue as the independent plant has them: laws of contact and friction that both codes
/// state alike (test_simulation, Rigs). @throws std::logic_error for any that a configuration does not admit.
independent_plant::Effects independent_effects(const std::vector<EffectConfig>& effects);

}  // namespace gapscope::internal::run
