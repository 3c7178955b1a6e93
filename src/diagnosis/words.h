#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// The answer in a sentence or two.
std::string sentence_of(const Diagnosis& diagnosis, Coordinates coordinates);

}  // namespace gapscope::internal::diagnosis
