#pragma once

#include "gapscope/base/encoder_side.h"
#include "results/json_archive.h"

namespace gapscope::internal::results {

/// On which side of the gap the encoder was, where that is not the motor's.
template <class Archive>
void encoder_side_field(Archive& archive, EncoderSide& side) {
  archive.seldom_choice("encoder", side,
                        Words<EncoderSide>{{EncoderSide::kMotor, "motor"}, {EncoderSide::kLoad, "load"}},
                        EncoderSide::kMotor);
}

}  // namespace gapscope::internal::results
