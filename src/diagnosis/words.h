#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// The answer in a sentence or two.
std::string sentence_of(const Diagnosis& diagnosis, Coordinates coordinates);

/// What an added effect is called, with what the sign of its parameters makes of it.
std::string name_of(const AddedEffect& added);

}  // namespace gapscope::internal::diagnosis
