#pragma once

#include <string>

#include "gapscope/diagnosis/card.h"

/// The lines of a card that speak of causes: what the model lacks, and what is gained by it.
namespace gapscope::internal::diagnosis {

inline constexpr const char* kToldByDiagnose = "Told by `gapscope diagnose CONFIG`.";

std::string cause_line(const CardFacts& facts);
std::string helps_line(const CardFacts& facts, const Card& card);

}  // namespace gapscope::internal::diagnosis
