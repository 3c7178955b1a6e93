#include "config/going_on.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::config {
namespace {

/// The own setting at the value that was found; of what the own model does not estimate the number as it is.
void go_on(ParameterSetting own, ParameterSetting& taken) {
  if (!own.estimate || taken.estimate || std::isnan(taken.value)) return;
  own.value = std::clamp(taken.value, std::isnan(own.low) ? -kInfinity : own.low,
                         std::isnan(own.high) ? kInfinity : own.high);
  own.begun = true;
  taken = own;
}

/// The k-th effect of an entry; nullptr: there are fewer.
const ModelEffect* effect_of(const ReferenceModel& model, const EffectEntry* entry, std::size_t k) {
  for (const ModelEffect& e : model.effects)
    if (e.entry == entry && k-- == 0) return &e;
  return nullptr;
}

/// As a search leaves alone what nothing else is known of.
void go_on_as_added(const ShaftTurns& turns, ModelEffect& effect) {
  for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i) {
    const double value = effect.parameters[i].value;
    const bool left_alone =
        effect.entry->parameters[i].held && !(std::abs(value - neutral_value(*effect.entry, i, turns)) > 0.0);
    if (!left_alone) go_on(ParameterSetting::sought(), effect.parameters[i]);
  }
}

}  // namespace

void estimate_as(const Configuration& own, bool keep_effects, ModelConfig& taken) {
  if (!own.model.given) return;
  const ReferenceModel model = own.reference_model();
  for (std::size_t i = 0; i < taken.parameters.size(); ++i) go_on(model.parameters[i], taken.parameters[i]);
  for (std::size_t e = 0; e < taken.effects.size() && !keep_effects; ++e) {
    ModelEffect& effect = taken.effects[e].effect;
    const auto before =
        std::count_if(taken.effects.begin(), taken.effects.begin() + static_cast<std::ptrdiff_t>(e),
                      [&](const EffectConfig& c) { return c.effect.entry == effect.entry; });
    if (const ModelEffect* mine = effect_of(model, effect.entry, static_cast<std::size_t>(before)))
      for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i)
        go_on(mine->parameters[i], effect.parameters[i]);
    else
      go_on_as_added(own.turns(), effect);
  }
}

}  // namespace gapscope::internal::config
