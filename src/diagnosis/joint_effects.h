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

/// Every effect of the drive's model and of the simulator's, ready to be fitted to both. Of two that are kin
/// (one contains the other, both contain a third, or one recording cannot tell them apart) only one is
/// there: which, is tried both ways. Where a model lacks an effect, its shape is held at the other's: only
/// its size and its phase are asked for.
/// @returns one or two sets, the one that prefers the drive's first
std::vector<std::vector<JointEffect>> joint_effects(const Diagnosis& drive, const Diagnosis& simulator);

}  // namespace gapscope::internal::diagnosis
