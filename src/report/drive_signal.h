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

}  // namespace gapscope::internal::report
