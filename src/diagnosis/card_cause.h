#pragma once

#include <string>

#include "gapscope/diagnosis/card.h"

namespace gapscope::internal::diagnosis {

inline constexpr const char* kToldByDiagnose = "Told by `gapscope diagnose CONFIG`.";

/// The line of a card that tells what the model lacks.
std::string cause_line(const CardFacts& facts);

/// The same without its reasons.
std::string brief_cause(const CardFacts& facts);

}  // namespace gapscope::internal::diagnosis
