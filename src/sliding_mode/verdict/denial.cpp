#include <algorithm>
#include <cmath>

#include "sliding_mode/hidden_gap.h"
#include "sliding_mode/verdict/informative.h"
#include "sliding_mode/verdict/pool.h"
#include "sliding_mode/visible_gap.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kVisible = 0.4;      ///< of the travel, from which on a gap could not have been seen
constexpr double kFewStriking = 0.3;  ///< of the half periods

/// Mean of u over what it swings by, from which on no contact opens, whatever its load weighs: the torque
/// that passes through it swings by a share of what u does, about the same mean. Of gravity_shut 1 to 12 it
/// is 0.55 to 15, above 1 in eleven, of high_friction 1 to 6, which nothing leans on, at most 0.03. Of those
/// twelve half takes the one of 0.55 as well, whose contact may open by this alone, double leaves two (1.2
/// and 1.5).
constexpr double kHeldClosed = 1.0;

/// No impact stands out, although every stroke left its marks, and there are gaps whose impacts would be more
/// abrupt than all of these. Friction that turns round may stand out a little.
bool shows_nothing(const Pool& pool) {
  return static_cast<double>(pool.striking) < kFewStriking * pool.half_periods &&
         static_cast<double>(pool.marks) >= 0.5 * pool.half_periods && pool.visible < kVisible * pool.travel;
}

/// Nothing was seen because nothing could have been seen.
bool too_slow(const Pool& pool) {
  const Refusal refusal = pool.commonest();
  return pool.accepted.empty() && pool.visible >= kVisible * pool.travel &&
         (refusal == Refusal::kContrast || refusal == Refusal::kNone);
}

}  // namespace

GapEvidence denial(const Pool& pool, double one_body, GapEvidence evidence) {
  if (pool.leaning > kHeldClosed) {
    evidence.against = words::held_closed(pool.leaning);
  } else if (is_informative(one_body, pool.travel, pool.encoder)) {
    evidence.denies = true;
    evidence.smallest_visible_gap = one_body;
    evidence.reading = words::one_body(kLightestLoad, pool.half_periods);
  } else if (shows_nothing(pool)) {
    evidence.smallest_visible_gap = std::min(one_body, pool.visible);
    evidence.against = words::only_large_gaps(one_body < pool.visible ? kLightestLoad : kSmallestMassRatio,
                                              evidence.smallest_visible_gap, pool.travel);
  } else if (too_slow(pool)) {
    evidence.against = words::too_slow(pool.visible);
  }
  return evidence;
}

}  // namespace gapscope::internal::sliding_mode
