#pragma once

#include <span>

#include "gapscope/plant/plant_model.h"

namespace gapscope::internal::reference {

/// The effect that delays the input, and does nothing else.
const EffectEntry& pure_delay();

/// Lets the model's input act that much later, exactly [s].
template <class T>
void delay_input(PlantModel<T>& model, const T& delay) {
  add_effect(model, pure_delay(), std::span<const T>(&delay, 1));
}

}  // namespace gapscope::internal::reference
