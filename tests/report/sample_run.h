#pragma once

#include "results/run_result.h"

namespace gapscope {

/// A run as the estimators would leave it, made without them: a two-inertia drive under a sine, integrated in
/// small fixed steps, a differentiator on its encoder, the true passages of the gap as events, and the same
/// drive with slightly other parameters as the fitted one.
struct SampleOptions {
  int samples = 25000;
  double rate = 2500.0;          ///< [Hz]
  double frequency = 1.0;        ///< of the sine [Hz]
  Coordinates coordinates = {};  ///< of a translation: a screw axis, metres and newtons, numbers 1/1000
  bool load_recorded = true;     ///< x2 in the recording
  bool detected = true;          ///< a model-free part
  bool fitted = true;            ///< a reference part
  bool one_inertia = false;      ///< the reference has no load behind a gap
  GapVerdict verdict = GapVerdict::kBacklash;
};

constexpr double kSampleGap = 0.0188;  // [rad], of the simulated drive

RunResult sample_run(const SampleOptions& options = {});

}  // namespace gapscope
