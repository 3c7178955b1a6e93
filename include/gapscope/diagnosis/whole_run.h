#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// A held-out recording beside the model under the drive's controller: the command goes in, the position
/// comes out.
struct ClosedLoopRun {
  std::string file;
  double before = kNaN, after = kNaN;  ///< rms of the position error, all the way [rad]
};

/// What users of a drive see that holds a position.
struct ClosedLoop {
  double before = kNaN, after = kNaN;  ///< rms over all recordings [rad]; NaN: the motion diverges
  std::vector<ClosedLoopRun> recordings;
};

/// The model simulated freely through whole held-out recordings, from their first state on: how far it ends
/// up from them at most. NaN: the motion diverges.
struct WholeRun {
  double before = kNaN, after = kNaN;  ///< largest error, without and with what was added [rad]
  double travel = kNaN;                ///< of the recording in which the former is [rad]
};

/// The fitted model beside a held-out recording, simulated from its first row to its last without a
/// correction: what a user of the model sees. Of a recording whose beginning was fitted, the part held out.
struct HeldOutRun {
  std::string file;
  double from = kNaN, to = kNaN;   ///< of the first and last row [s]
  bool closed = false;             ///< under its controller: goal in, position out
  double rmse = kNaN, mae = kNaN;  ///< of the position [rad]; NaN: the motion diverges, as below
  double fit = kNaN;               ///< 100 (1 − |x1 − x̂1|/|x1 − mean|) [%]
  double nominal_fit = kNaN;       ///< the same of the model without what was added [%]
};

/// The model with the numbers that the configuration gives it, before any fit.
struct AsConfigured {
  double error = kNaN;  ///< as MismatchSize::before [rad]; NaN: the motion diverges
};

}  // namespace gapscope
