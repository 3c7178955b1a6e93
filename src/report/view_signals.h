#pragma once

#include <string>
#include <vector>

#include "report/report_view.h"

namespace gapscope::internal::report {

/// The motor torque (force) where the torque constant is known, else the input itself.
struct DriveSignal {
  std::vector<double> values;
  Axis axis;
  std::string name;  ///< for sentences
};
DriveSignal drive_signal(const ReportView& view);

/// For loops, which noise of the input blurs: the mean over a hundredth of a half period where the steps from
/// sample to sample show such noise (more than 0.5 % of the range in the median), else the signal itself.
std::vector<double> without_noise(const ReportView& view, const std::vector<double>& values);

/// The factor N of step S2 that makes e_x comparable with a signal of the given size [rad]: the detector's
/// own where that shows e_x well beside it, else a round one.
double error_factor(const ReportView& view, const Interval& interval, double target);

/// N·e_x over an interval, labelled with its factor.
Series scaled_error(const ReportView& view, const Interval& interval, double target);

}  // namespace gapscope::internal::report
