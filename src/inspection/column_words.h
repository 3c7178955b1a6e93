#pragma once

#include <string>

#include "gapscope/base/encoder_side.h"

namespace gapscope::internal::inspection {

/// What a column may be of a recording.
enum class ColumnRole { kTime, kInput, kPosition, kSpeed, kTarget };

/// How well the name of a column says a role: 0 not at all, else the more the better.
int likeness(const std::string& name, ColumnRole role);

/// Of a name with a word for the side of the motor or of the load: 1 for the one that is asked for, -1 for
/// the other one; 0: no word for either, or both.
int sidedness(const std::string& name, EncoderSide side);

/// Words and numbers that two names have both: "pos (1)" and "load (1)" one.
int shared_words(const std::string& a, const std::string& b);

}  // namespace gapscope::internal::inspection
