#pragma once

#include <span>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// Encoder quanta in the smallest gap that is read as a rule.
constexpr double kFewestGapQuanta = 40.0;

/// … and in the smallest that is told at all. Of study_sliding_mode 700001 300 gap sine and 3610001 120 gap
/// trapezoid four more are told with 20 instead of 40, all within their intervals and 2 %; none of 3620001
/// 210 gap_free sine.
constexpr double kFewestToldQuanta = 20.0;

/// σ of what rounding to whole quanta does to a moving position: q/√12.
double rounding_noise(double quantum);

/// The quantum that a trace comes with, else the one its samples show; 0 if neither is known [rad].
double encoder_quantum(const MotorTrace& trace);

/// The quantum that raw samples show; where they step too rarely for it to be counted, the smallest step
/// [rad].
double quantum_or_least_step(std::span<const double> x1);

/// What the encoder alone leaves: q/√12 of the quantum the trace comes with, or its noise at rest if that is
/// larger [rad]. Never 0, and nothing of the motion: a floor that grew with what a model leaves would forgive
/// it.
double encoder_floor(const MotorTrace& trace);

/// Whether a way is more than one count, to the nearest: the last count of a drive that stands flickers, too.
/// @param floor  encoder_floor(), of which one count is √12 [rad]
bool exceeds_a_count(double way, double floor);

}  // namespace gapscope::internal::signals
