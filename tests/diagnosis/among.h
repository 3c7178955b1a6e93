#pragma once

#include "base/text.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::test {

/// These are the only candidates, and no law of last resort is laid over what they leave.
inline DiagnosisOptions among(const std::vector<std::string>& candidates) {
  DiagnosisOptions options;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* e : table)
      if (!contains(candidates, e->name)) options.excluded.emplace_back(e->name);
  return options;
}

}  // namespace gapscope::test
