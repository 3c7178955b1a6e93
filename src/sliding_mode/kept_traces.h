#pragma once

#include <span>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "gapscope/sliding_mode/super_twisting.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// t_c of S2: since when e_x had been quiet before t1 [s]: within `rest`, and on the scale of the passage,
/// which is what it reaches from t1 until as long after t2. NaN where it was not, or where that is longer
/// than half a period.
/// @param half_period  [s]; not positive: ten passages
/// @param rest  what noise and chatter leave of |e_x| [rad]
double at_rest_since(const ErrorTrace& error, double start, double dt, const GapEvent& event,
                     double half_period, double rest);

/// e_x of one bound for every recording, its scale N, and t_c of each event. Nothing without a bound.
/// @param facts  one per recording
void keep_traces(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                 double bound, Discretisation discretisation, GapEstimate& estimate);

}  // namespace gapscope::internal::sliding_mode
