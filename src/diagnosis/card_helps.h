#pragma once

#include <string>

#include "gapscope/diagnosis/card.h"

namespace gapscope::internal::diagnosis {

/// The line of a card that tells what is gained by what was added, and what is left.
std::string helps_line(const CardFacts& facts, const Card& card);

/// The same without amounts and what is left.
std::string brief_helps(const CardFacts& facts, const Card& card);

}  // namespace gapscope::internal::diagnosis
