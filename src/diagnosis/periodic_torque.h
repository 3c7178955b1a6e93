#pragma once

#include <span>
#include <vector>

#include "diagnosis/harmonics.h"
#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// The lines of a model's correcting torque over the motor angle: those whose period was given, and those
/// that stand out where the model was fitted and hold on what is held out.
/// @param held_out playbacks of the model
std::vector<PeriodicTorque> periodic_torques(const Study& study, const ReferenceModel& model,
                                             const std::vector<Playback>& held_out);

/// N of every period that was given.
std::vector<double> given_periods(const DiagnosisKnowledge& known);

/// Torque series of playbacks from the ripple observer, spikes cut.
std::vector<std::vector<double>> ripples_of(const std::vector<Playback>& playbacks);

/// A line of the correcting torque that stands out.
struct TorqueLine {
  Harmonic line;
  double over = 0.0;  ///< its share of the squared torque over the median of its neighbours'
};

/// Lines of the correcting torque over the motor angle that stand out from what it shows at neighbouring
/// periods, strongest first; each is taken out before the next one is looked for. The period is a number like
/// any other: it is searched for on a fine grid and then refined.
/// @param torque see ripples_of()
std::vector<TorqueLine> standing_lines(std::vector<std::vector<double>> torque,
                                       std::span<const MotorTrace> traces);

/// Amplitudes at one N, as the observer passes them on: its lag, which grows with the speed, is accounted
/// for.
TorqueLine fitted_line(std::span<const std::vector<double>> torque, std::span<const MotorTrace> traces,
                       double periods);

/// How many windows of what is held out a line at this N improves. Its amplitudes are those of every other
/// window: an encoder that counts from where it was switched on does not keep the phase.
struct LineCheck {
  int windows = 0, better = 0;
  bool holds() const;  ///< more windows improve than chance would let
};
LineCheck check_line(double periods, std::span<const std::vector<double>> torque, const HeldOut& held_out);

}  // namespace gapscope::internal::diagnosis
