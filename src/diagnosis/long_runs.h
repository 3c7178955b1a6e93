#pragma once

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// A model that misses something yet, with its numbers where it runs freely along the recordings that are
/// fitted, which is what a simulation does, while the correcting torque keeps them physical: a free run alone
/// bends inertia and friction to hide drift, and the torque alone does not see what adds up to it.
///
/// All numbers together go down the mean log of the sizes of the correcting torque and of what free runs miss
/// that begin anew for each of 1, 3 and 12 parts of a recording, where an observer has the state there. Where
/// a controller is known that made the inputs, it is in the loop, and a run is the whole recording. Fine
/// lines over the position stay as they are: a run drifts off by more than their period. The same model where
/// no step does better, where it has a load or estimates a controller.
FittedModel fitted_for_runs(const Study& study, const FittedModel& model);

/// A model whose structure is decided, with its numbers where fit() would end, see there: a search of effects
/// stops as soon as it can tell them apart. Only the training recordings move them, and what is held out
/// judges it anew. The same where the model is not the drive. It is no search: a request to finish does not
/// end it, and what was found by then has the same numbers.
ScoredModel settled(const Study& study, const ScoredModel& model);

}  // namespace gapscope::internal::diagnosis
