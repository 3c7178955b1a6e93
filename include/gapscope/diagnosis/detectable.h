#pragma once

#include <string>
#include <vector>

#include "gapscope/diagnosis/named_value.h"

namespace gapscope {

/// "Would I have seen it?": the smallest amount of an effect that the diagnosis would have named on these
/// very recordings, on top of the model that it has come to. Foretold to first order, without a refit of the
/// simulator; where the torque balance decides and it was asked for, corrected by implants into its rows.
struct DetectableEffect {
  std::string effect;
  NamedValue smallest;         ///< of the parameter that is its size; NaN: it cannot be shown at any amount
  std::vector<NamedValue> at;  ///< the effect's other numbers that this was foretold for
  std::string hidden_by;  ///< where it cannot: the effect or law that says it as well, or "model"; else empty
  std::string why;        ///< the same in words
  double torque = kNaN;   ///< rms of the torque that the smallest amount makes on the held-out data [N m]

  bool can_be_shown() const { return smallest.value == smallest.value; }
};

}  // namespace gapscope
