#include "gapscope/recording/recording.h"

#include <algorithm>
#include <cmath>

namespace gapscope {

const char* to_string(Mode mode) {
  switch (mode) {
    case Mode::kGap: return "gap";
    case Mode::kEngagementPlus: return "engagement+";
    case Mode::kEngagementMinus: return "engagement-";
    case Mode::kImpact: return "impact";
  }
  return "";
}

}  // namespace gapscope
