#pragma once

#include <vector>

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// Every effect of a list that the model could have, refitted and judged, best first.
/// @param first_step false: where none explains much, those that trail are not tried again, and nothing comes
/// back
///   once it was asked to finish
std::vector<ScoredModel> candidates_of(const Study& study, const ScoredModel& before,
                                       const std::vector<const EffectEntry*>& catalogue,
                                       bool first_step = true);

/// The model beside what it was fitted to, see play().
std::vector<Playback> play_on_train(const Study& study, const ReferenceModel& model);

}  // namespace gapscope::internal::diagnosis
