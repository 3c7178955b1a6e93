#pragma once

#include <string>

#include "gapscope/diagnosis/card.h"

namespace gapscope::internal::diagnosis {

/// The line of the model's error, but for the tolerance: how much the model misses, and how far it drifts.
std::string mismatch_words(const CardFacts& facts, const Card& card);

/// How much the model misses, and what that rests on.
std::string mismatch_size(const CardFacts& facts, const Card& card);

}  // namespace gapscope::internal::diagnosis
