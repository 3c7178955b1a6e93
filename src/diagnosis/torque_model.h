#pragma once

#include "diagnosis/study.h"
#include "torque_view/ladder.h"

namespace gapscope::internal::diagnosis {

/// What the coefficients of the terms of a budget are told relative to.
torque_view::Drive drive_of(const torque_view::Model& terms, const torque_view::Budget& budget,
                            const ReferenceModel& model);

/// The nominal model with the terms of the ladder that it can have, at their values in the torque balance.
ReferenceModel with_terms(ReferenceModel model, const torque_view::Budget& budget);

/// Whether the simulator's refit has taken the effect away again.
bool has_vanished(const ModelEffect& effect);

/// The numbers of the torque balance, or, where the simulator comes near the floor from there, those of its
/// refit. Where torque is missing that nothing explains, the innovations of an observer favour a heavy drive,
/// which hides it; the contact of a locked output, which the balance has in no parameter of the model, is
/// refitted if that leaves less and keeps what was added.
ScoredModel refitted_from(const Study& study, const ReferenceModel& balanced);

}  // namespace gapscope::internal::diagnosis
