#pragma once

#include <vector>

#include "diagnosis/side.h"

namespace gapscope::internal::diagnosis {

/// A part of each recording of drive and simulator that is compared.
struct Stretch {
  MotorTrace drive, simulator;
  std::size_t from = 0, to = 0;
};

/// Free runs of a model from given starts; an empty one diverges.
using FreeRuns = std::vector<std::vector<double>>;
FreeRuns free_runs(const ReferenceModel& model, const std::vector<MotorTrace>& traces,
                   const std::vector<reference::RecordingStart>& starts);

/// The model fitted to the simulator in the simulator's place, which cannot be run here.
class StandIn {
 public:
  StandIn(ReferenceModel model, std::vector<Stretch> stretches);

  /// rms from the drive's x1, of the simulator as recorded or of a model from the simulator's starts;
  /// infinite where it diverges [rad].
  double simulator_error() const;
  double error_of(const ReferenceModel& model) const;
  /// rms from the simulator's x1 [rad].
  double miss() const;

  const ReferenceModel& model() const { return model_; }
  FreeRuns runs_of(const ReferenceModel& model) const { return free_runs(model, simulated_, starts_); }

 private:
  template <class Value>
  double rms(Value&& error) const;

  ReferenceModel model_;
  std::vector<Stretch> stretches_;
  std::vector<MotorTrace> simulated_;
  std::vector<reference::RecordingStart> starts_;
};

}  // namespace gapscope::internal::diagnosis
