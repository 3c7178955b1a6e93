#pragma once

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// Encoder floor of all held-out recordings together [rad].
double pooled_floor(const HeldOut& held_out);

/// (before − after)/(before − 1) of two sizes in floors; NaN while before < 1.3.
double shrink_of(double before, double after);

/// The windows that the gap is measured by, and their floor [rad].
std::vector<double> Windows::*judged_windows(const Study& study);
double judged_floor(const Study& study);

MismatchSize mismatch_size(const Study& study, const ScoredModel& before, const ScoredModel& after);

/// Where the shrink of a free-form law lies on the next recording. Unlike a named law it holds no farther
/// than it was fitted: the median may lie among windows where it does, while the next recording is one of
/// those where it does not. So the share that it leaves lies between that of the best windows and that of the
/// mean square, in which the worst ones count, and beyond them as far as that of any effect.
Interval law_shrink_interval(const Study& study, const ScoredModel& before, const ScoredModel& after);

/// What the sheet leaves of the judged windows before any fit; nothing where it leaves numbers to the fit, or
/// nothing is fitted.
std::optional<AsConfigured> as_configured(const Study& study);

/// Restarted free runs, innovations at both gains and the correcting torque, side by side.
std::vector<MismatchMeasure> measures_of(const Study& study, const std::vector<Playback>& before,
                                         const std::vector<Playback>& after);

/// What the fitted recordings leave open of the held-out motion: the standard deviation of its prediction
/// [rad]; NaN where a motion diverges.
double undetermined_by(const Study& study, const ReferenceModel& model);

/// The model without and with what was added, simulated freely through what is held out.
WholeRun whole_run(const HeldOut& held_out, const Positions& before, const Positions& after);

/// Weight of a candidate against the best one: exp(−ΔS/T).
double weight_of(const ScoredModel& candidate, const ScoredModel& best);

}  // namespace gapscope::internal::diagnosis
