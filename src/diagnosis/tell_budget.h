#pragma once

#include <vector>

#include "diagnosis/torque_search.h"

namespace gapscope::internal::diagnosis {

/// What the model with the effects that were added leaves, as far as the budget has that model, and which of
/// them it does not have.
void count_added(const torque_view::Budget& budget, Diagnosis& diagnosis);

/// The error budget and the size of the mismatch in torque, as they are told: none where the motion refutes
/// it.
void tell_budget(const Study& study, const torque_view::Budget& budget, Diagnosis& diagnosis);

/// What each effect that the ladder has added takes.
std::vector<AddedEffect> added_effects(const torque_view::Budget& budget, const TorqueSearch& ladder);

/// The numbers of an effect, by their keys.
std::vector<NamedValue> effect_values(const ModelEffect& effect);
/// Of an effect of the model, or of the one that contains it; empty if it has neither.
std::vector<NamedValue> values_in(const ReferenceModel& model, const EffectEntry& entry);

}  // namespace gapscope::internal::diagnosis
