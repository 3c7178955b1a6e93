#pragma once

#include <cstddef>
#include <optional>

#include "sliding_mode/marks/marks.h"

namespace gapscope::internal::sliding_mode {

/// Steps S3 and S4 on one error signal e_x where its instants do not lie at a sample: e_x follows ÿ smoothly,
/// so a jump in the course of ÿ bends it, and the kink of a local fit is the instant. All in samples.

/// S4: where e_x begins to fall abruptly, at or before its peak. `since` is when it left zero or bent before.
double bend_before_peak(const BankErrors& run, const Excursion& ramp, double since);

/// S3 where the sliding mode was already lost while engaged (k₂ below that acceleration): e_x is not zero,
/// but it diverges from its smooth course when the contact is lost, because the motor alone gains speed
/// faster. Looked for around `turn`, where x1 turns round. Nothing if no such bend stands out, or if e_x was
/// zero there.
std::optional<double> bend_at_release(const BankErrors& run, const Excursion& ramp, std::size_t turn);

}  // namespace gapscope::internal::sliding_mode
