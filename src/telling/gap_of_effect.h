#pragma once

#include <algorithm>

#include "diagnosis/numbers.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "telling/answer.h"

namespace gapscope::internal::telling {

/// Whether the gap is that of an effect that divides the one body of the model: rigid at its contact and with
/// all friction on the motor's side, it shows that there is a gap rather than how wide it is.
inline bool divides_one_body(const Diagnosis& d) {
  return std::ranges::find(d.added, "backlash", &AddedEffect::effect) != d.added.end();
}

/// By how much the recordings leave a gap open: half its interval over it.
inline double open_share(const Answer& gap) { return 0.5 * (gap.ci95.high - gap.ci95.low) / gap.gap; }

/// Whether that is more than a part of it, which then rests on the form of the contact's law, and nobody
/// knows that.
inline bool is_open(const Answer& gap) { return open_share(gap) > diagnosis::kTelling.open_gap; }

}  // namespace gapscope::internal::telling
