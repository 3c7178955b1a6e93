#pragma once

#include "gapscope/recording/recording.h"
#include "signals/signal_facts.h"
#include "sliding_mode/marks/marks.h"

namespace gapscope::internal::sliding_mode {

/// Smallest mass ratio of load and motor for which the impacts of a gap are said to be visible: lighter loads
/// leave weaker ones.
constexpr double kSmallestMassRatio = 0.3;

/// The smallest gap whose impacts would have shown in this motion [rad]; infinite if none would.
/// An impact shows when its Δv leaves a peak kStepPeak Δv²/k₂ of twice the floor at a bound above which the
/// motion itself shows nothing (`hiding`, an index: detents and stick-slip hide weaker impacts). Two
/// estimates of the speed v at which a gap g would have been closed are taken, the slower one counts: v² =
/// L_acc g, and the speed that the motor really has at the distance g from its reversals. Of v, an impact on
/// a load at rest leaves Δv = (1 + e) μ/(1 + μ) v, with the smallest mass ratio μ and restitution e.
double smallest_visible_gap(const MotorTrace& trace, const signals::SignalFacts& facts, const BankRun& run,
                            std::size_t hiding);

/// What encoder and noise alone would allow [rad]: the same where nothing of the motion hides an impact, with
/// a floor of one count or 1.5 σ_n at the bound that the motion needs, so v² = L_acc g.
double encoder_visible_gap(const signals::SignalFacts& facts);

/// The smallest gap that could not hide in what one body with friction leaves of this recording [rad]. Across
/// a gap 2β the motor is up to μ/(1 + μ) β off the centre of both masses, to one side and then to the other,
/// without the load's inertia and friction, and no law of one body does so. How much of that is left depends
/// on the motion: it is seen on the body that was found, with the lightest load that is asked for behind a
/// gap (OneBodyFit::hidden). Infinite where that is no less than the travel, and where a constant torque may
/// keep such a load on one flank.
double one_body_visible_gap(const MotorTrace& trace, const signals::SignalFacts& facts);

}  // namespace gapscope::internal::sliding_mode
