#include "diagnosis/effect_starts.h"

#include <cmath>

#include "base/require.h"

namespace gapscope::internal::diagnosis {

std::vector<EffectStart> effect_starts(const EffectEntry& entry) {
  if (!entry.starts.empty()) return {entry.starts.begin(), entry.starts.end()};
  EffectStart start{};
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const EffectParameterSpec& p = entry.parameters[i];
    start[i] = p.low + 0.1 * (p.high - p.low);
  }
  return {start};
}

ModelEffect searched_effect(const EffectEntry& entry, const std::vector<double>& values,
                            const ShaftTurns& turns) {
  GAPSCOPE_REQUIRE(values.size() == entry.parameters.size());
  ModelEffect effect;
  effect.entry = &entry;
  for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
    const double neutral = neutral_value(entry, i, turns);
    const bool left_alone = entry.parameters[i].held && (std::isnan(values[i]) || values[i] == neutral);
    effect.parameters[i] =
        left_alone ? ParameterSetting::known(neutral) : ParameterSetting::sought(values[i]);
  }
  return effect;
}

ModelEffect searched_effect(const EffectEntry& entry, const ShaftTurns& turns) {
  return searched_effect(entry, std::vector<double>(entry.parameters.size(), kNaN), turns);
}

}  // namespace gapscope::internal::diagnosis
