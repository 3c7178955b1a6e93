#pragma once

#include "diagnosis/study.h"
#include "torque_view/ladder.h"

namespace gapscope::internal::diagnosis {

/// Whether a model has a gap, or estimates one.
bool has_play(const ReferenceModel& model);

/// The law of the torque balance that an effect follows; nullptr: it has none.
const torque_view::Law* law_of(const EffectEntry& entry);

/// What the model has beside inertia and viscous damping, at its shapes: its contact, where the output is
/// locked, and its effects.
torque_view::Model known_terms(const ReferenceModel& model, const torque_view::SplitRecordings& data,
                               const torque_view::Scales& scales);

/// What the coefficients of the terms of a budget are told relative to.
torque_view::Drive drive_of(const torque_view::Model& terms, const torque_view::Budget& budget,
                            const ReferenceModel& model);

/// The nominal model with the terms of the ladder that it can have, at their values in the torque balance.
ReferenceModel with_terms(ReferenceModel model, const torque_view::Budget& budget);

/// Whether the simulator's refit has taken the effect away again.
bool has_vanished(const ModelEffect& effect);

/// Whether it has left no more than a tenth (DecisionRule::faded) of any size of it: what the balance took
/// for it was none of it.
/// @param balanced  the same effect as the balance had it
bool has_faded(const ModelEffect& refitted, const ModelEffect& balanced);

/// The numbers of the torque balance, or, where the simulator comes near the floor from there, those of its
/// refit. Where torque is missing that nothing explains, the innovations of an observer favour a heavy drive,
/// which hides it; the contact of a locked output, which the balance has in no parameter of the model, is
/// refitted if that leaves less and keeps what was added. So is a drive that the balance's numbers bring no
/// nearer to the motion than `nominal` is, and its refit does (of a torque constant that only an anchor
/// bounds, for one, the balance keeps what the nominal model had, without what was added), and one that its
/// refit brings far nearer than they do.
ScoredModel refitted_from(const Study& study, const ReferenceModel& balanced, const ScoredModel& nominal);

}  // namespace gapscope::internal::diagnosis
