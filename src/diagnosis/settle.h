#pragma once

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// A model whose structure is decided, with its numbers where fit() would end, see there: a search of effects
/// stops as soon as it can tell them apart. Only the training recordings move them, and what is held out
/// judges it anew. The same where the model is not the drive. It is no search: a request to finish does not
/// end it, and what was found by then has the same numbers.
ScoredModel settled(const Study& study, const ScoredModel& model);

}  // namespace gapscope::internal::diagnosis
