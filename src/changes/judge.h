#pragma once

#include <optional>

#include "results/drive_changes.h"

namespace gapscope::internal::changes {

/// How likely it is that a word of any row is wrong.
inline constexpr double kErrorRate = 0.05;

/// A difference that matters, where no tolerance was stated: this part of the larger value.
inline constexpr double kMatters = 0.1;

/// The difference of two observations with its interval of 95 %, its p and what other torques can make of it;
/// without a verdict.
Change change_between(const Observation& first, const Observation& now);

/// Gives every change its verdict, all rows at one error rate, and counts them.
/// @param tolerance  for what is measured in the unit of the position [rad]; nothing: none was stated
void give_verdicts(DriveChanges& all, std::optional<double> tolerance);

}  // namespace gapscope::internal::changes
