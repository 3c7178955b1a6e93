#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// The answer in a sentence or two.
std::string sentence_of(const Diagnosis& diagnosis, Coordinates coordinates);

/// Whether the first cause is open and a later one established: that one holds with the first in the model.
bool rests_on_open_cause(const Diagnosis& diagnosis);

/// What an added effect is called, with what the sign of its parameters makes of it, and with its period
/// where it was added more than once.
std::string name_of(const AddedEffect& added, const Diagnosis& diagnosis, Coordinates coordinates);

}  // namespace gapscope::internal::diagnosis
