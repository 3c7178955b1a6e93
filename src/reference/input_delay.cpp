#include "reference/input_delay.h"

#include "gapscope/plant/effect.h"

namespace gapscope::internal::reference {

const EffectEntry& pure_delay() {
  static const EffectEntry& entry = *find_effect("input_delay");
  return entry;
}

}  // namespace gapscope::internal::reference
