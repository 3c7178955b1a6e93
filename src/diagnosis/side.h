#pragma once

#include <vector>

#include "diagnosis/held_out.h"
#include "diagnosis/joint_effects.h"

namespace gapscope::internal::diagnosis {

/// The recordings of the drive, or of the simulator, as the comparison fits and judges them.
struct Side {
  std::vector<MotorTrace> train;
  HeldOut judged;
  double observer_hz = 0.0;
  FitOptions fit;
};
Side side_of(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out, double observer_hz,
             const DiagnosisOptions& options);

/// A model fitted to a side.
struct SideFit {
  ReferenceModel model;
  std::vector<reference::RecordingStart> starts;
  double error = kInfinity;  ///< rms of restarted free runs on what judges [rad]; infinite: it diverges
};
SideFit fit_side(const Side& side, const ReferenceModel& from);

/// Standard deviations of these numbers of the fit; NaN for what it does not ask for or determine.
std::vector<double> spreads_of(const Side& side, const SideFit& fit,
                               const std::vector<reference::ParameterId>& ids);

/// rms that a fit with less freedom leaves beyond what the free one does [rad].
double excess(const SideFit& pinned, const SideFit& free);

/// The model with these numbers taken from another one and held there.
ReferenceModel pinned(ReferenceModel model, const ReferenceModel& at,
                      const std::vector<reference::ParameterId>& ids);

/// The same, every number as free as it was.
ReferenceModel with_numbers(ReferenceModel model, const ReferenceModel& by,
                            const std::vector<reference::ParameterId>& ids);

}  // namespace gapscope::internal::diagnosis
