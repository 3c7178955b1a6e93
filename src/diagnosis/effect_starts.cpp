#include "diagnosis/effect_starts.h"

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

}  // namespace gapscope::internal::diagnosis
