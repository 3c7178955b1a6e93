#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// The answer in one sentence.
std::string sentence_of(const Diagnosis& diagnosis);

}  // namespace gapscope::internal::diagnosis
