#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/side.h"
#include "diagnosis/simulator.h"

namespace gapscope::internal::diagnosis {

/// Drive and simulator with one set of joint effects.
struct JointFit {
  std::vector<JointEffect> effects;
  SideFit drive, simulator;

  bool usable() const { return std::isfinite(drive.error) && std::isfinite(simulator.error); }
  double log_error(double floor) const {
    return std::log(std::hypot(drive.error, floor)) + std::log(std::hypot(simulator.error, floor));
  }
};

/// A row, and the numbers of the model that it stands for.
struct PlannedRow {
  SimulatorRow row;
  std::vector<reference::ParameterId> ids;
  int effect = reference::ParameterId::kDrive;
};

/// The effects of both, then the parameters that are estimated; nothing is measured yet.
std::vector<PlannedRow> planned_rows(const JointFit& fit);

/// What a row is measured with.
struct RowInstrument {
  const Side& drive;
  const Side& simulator;
  double floor = 0.0;  ///< [rad]
};

/// Fills in the numbers, their size in the motion, and where the row's effect shows.
void measure(const RowInstrument& instrument, const JointFit& fit, PlannedRow& planned);

}  // namespace gapscope::internal::diagnosis
