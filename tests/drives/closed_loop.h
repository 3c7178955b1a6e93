#pragma once

#include <cstdint>
#include <vector>

#include "drives/controller.h"
#include "independent_plant/simulate.h"

namespace gapscope::independent_plant {

/// What stands in the column u.
enum class RecordedInput {
  kCommand,  ///< what the controller's electronics send, with its dead time, before the drive's own effects
  kCurrent,  ///< what the motor is driven by, measured
};

/// How a recording of a loop comes about.
struct LoopRecorder {
  double rate = 0.0;  ///< rows at times of their own [Hz]; 0: at each turn of the controller
  RecordedInput input = RecordedInput::kCommand;
  double input_noise = 0.0;  ///< rms, of a measured current [unit of u]
  double lead_s = 0.0;       ///< the loop is at work that long before the first row
  double lost_share = 0.0;   ///< of the rows, in runs
  double lost_run = 4.0;     ///< mean rows lost at a time
};

/// A recording in closed loop. With jitter, or rows lost, the stamps are uneven and recording.dt is their
/// mean step. Time begins where the loop does, so recording.start is the lead.
struct LoopRun {
  BlindRun run;
  std::vector<double> stamps;  ///< [s]
  std::vector<Target> target;  ///< of the controller, at the stamps
  std::vector<double> supply;  ///< that the commands were multiplied by, at the stamps [-]
};

/// The drive under a controller that reads its encoder and follows a reference. `options.rate` says nothing
/// here; its duration is that of the recorded rows. Deterministic in its arguments.
LoopRun simulate_closed_loop(const BlindDrive& drive, const ReferenceMotion& reference,
                             const ControllerSettings& controller, const BlindSensor& sensor,
                             const LoopRecorder& recorder = {}, const BlindOptions& options = {});

}  // namespace gapscope::independent_plant
