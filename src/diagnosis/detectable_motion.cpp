#include "diagnosis/detectable.h"

namespace gapscope::internal::diagnosis {

std::vector<DetectableEffect> detectable_in_motion(const Study&, const ReferenceModel&,
                                                   const std::vector<const EffectEntry*>& asked) {
  std::vector<DetectableEffect> detectable;
  for (const EffectEntry* entry : asked) detectable.push_back(not_detectable(*entry, "", ""));
  return detectable;
}

}  // namespace gapscope::internal::diagnosis
