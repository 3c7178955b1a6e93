#pragma once

#include "independent_plant/simulate.h"

namespace gapscope::independent_plant {

/// Writes down what a rig does, sample by sample.
class RunRecorder {
 public:
  RunRecorder(const BlindSensor& sensor, double start, double dt);

  /// The sample of the present: the input and the position as they are recorded, beside the truth.
  void note(const Rig& rig, double u, double x1);
  BlindRun finished(const Rig& rig);

 private:
  BlindRun run_;
};

}  // namespace gapscope::independent_plant
