#pragma once

#include <vector>

#include "results/drive_changes.h"

namespace gapscope::internal::changes {

/// Fewest reports of which a course in time, or an odd one, is told.
inline constexpr int kFewestInOrder = 4;

/// The course of every quantity that enough reports give a value of. The change is where two means, before
/// and after, leave least; it is told where they differ by more than chance, 5 % for all quantities and
/// places together. Errors are those of the reports, or what neighbours in time differ by where that is more.
std::vector<QuantityCourse> courses(const DriveChanges& all);

/// Units that are unlike the others, in a quantity of which enough have a value: by Student's t against the
/// others, whose mean and spread are estimated knowing the error of each: what is measured well counts more,
/// and errors are no spread. 5 % for all units and quantities together. The farthest first.
std::vector<OddUnit> odd_units(const DriveChanges& all);

}  // namespace gapscope::internal::changes
