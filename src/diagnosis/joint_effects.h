#pragma once

#include <string>
#include <vector>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

/// An effect that either of two diagnoses has in its model.
struct JointEffect {
  ModelEffect drive, simulator;                 ///< with what each fit begins
  bool in_drive = false, in_simulator = false;  ///< it, or one of its kin, is in that model
  std::vector<std::string> group;               ///< that it cannot be told from, itself included
};

/// The parameters that say how much there is of an effect: with all of them where it is absent, it is not
/// there. The first one, and of a law that contains a simpler one what it adds to that, whatever the level
/// (the ratio of a load-dependent friction); of a free-form law, whose first number is what it is laid over,
/// all that vanish.
std::vector<std::size_t> sizes_of(const EffectEntry& entry);

/// Whether all that is of an effect is where it is absent.
bool is_absent(const ModelEffect& effect);

/// Every effect of the drive's model and of the simulator's, ready to be fitted to both. Of two that are kin
/// (one contains the other, both contain a third, or one recording cannot tell them apart) only one is
/// there: which, is tried both ways. Where a model lacks an effect, its shape is held at the other's: only
/// its sizes and its phase are asked for.
/// @returns one or two sets, the one that prefers the drive's first
std::vector<std::vector<JointEffect>> joint_effects(const Diagnosis& drive, const Diagnosis& simulator);

}  // namespace gapscope::internal::diagnosis
