#pragma once

#include <string>
#include <vector>

#include "report/report_view.h"

namespace gapscope::internal {

/// The motor torque (force) where the torque constant is known, else the input itself.
struct DriveSignal {
  std::vector<double> values;
  Axis axis;
  std::string name;  ///< for sentences
};
DriveSignal drive_signal(const ReportView& view);

}  // namespace gapscope::internal
