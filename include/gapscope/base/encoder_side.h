#pragma once

namespace gapscope {

/// On which side of the gap the encoder is whose position the estimators read.
enum class EncoderSide { kMotor, kLoad };

inline const char* to_string(EncoderSide side) { return side == EncoderSide::kLoad ? "load" : "motor"; }

}  // namespace gapscope
