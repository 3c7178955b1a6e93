#pragma once

#include <vector>

#include "diagnosis/further.h"
#include "gapscope/diagnosis/next_experiment.h"

namespace gapscope::internal::diagnosis {

/// The rivals of the first step that leaves a question: its best candidate, and the next one that the data
/// hardly tells from it. None where all is clear, and none on top of effects that were not added: what nobody
/// believes leaves no question.
std::vector<Rival> open_question(const FirstSearch& found, const Additions& added);

}  // namespace gapscope::internal::diagnosis
