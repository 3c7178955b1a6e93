#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::telling {

/// The place of a mismatch in words that follow "the missing torque": "is periodic in the motor angle with 24
/// cycles per turn".
std::string headline_of(const MismatchPlace& place, Coordinates coordinates,
                        EncoderSide encoder = EncoderSide::kMotor);

}  // namespace gapscope::internal::telling
