#pragma once

#include <span>

#include "changes/drive_report.h"
#include "results/drive_changes.h"

namespace gapscope {

/// Sets every report against the first one, in every quantity that either tells.
///
/// Difference of two values (v, w) with the intervals (l, u): by the square sum of what faces each other (Zou
/// and Donner, Statistics in Medicine 27, 2008), which keeps intervals that are wider on one side so:
///   low = w − v − √((w − l_w)² + (u_v − v)²),  high = w − v + √((u_w − w)² + (v − l_v)²)
/// A bound against a value or a bound: all that the two leave possible.
///
/// One error rate for all n rows together (Bonferroni): each interval is taken as wide as 1 − 0.05/n holds,
/// so all of them hold in 95 % of the comparisons. A row is `changed` where that interval, and what other
/// torques alone can make, leaves zero out; `same` where it lies within the tolerance, stated or a tenth of
/// the larger value; else `open`. Neither word is wrong in any row more often than in one comparison of
/// twenty.
///
/// Intervals are those of single recordings: what a drive does differently from day to day is not in them.
/// What a reading without a model does not know of its t1 and t2 is in its interval as if it were another
/// error in each report. Where both were read alike it is partly the same one: the interval of the difference
/// is then wider than it need be, never narrower.
/// Which numbers of the fits differ is told of each report against the first (see which.h), and of four
/// reports or more the course of each quantity in time, or of units those unlike the others (see series.h).
/// @throws ConfigError for reports in different coordinates, std::logic_error for fewer than two
DriveChanges changes(std::span<const DriveReport> reports, ReportOrder order = ReportOrder::kInTime);

}  // namespace gapscope
