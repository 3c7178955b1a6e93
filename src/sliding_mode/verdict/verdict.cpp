#include "sliding_mode/verdict/verdict.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/normal.h"
#include "sliding_mode/verdict/pool.h"
#include "sliding_mode/verdict/pooled_reading.h"
#include "sliding_mode/verdict/shelf.h"
#include "sliding_mode/visible_gap.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// Smallest gap that cannot hide in what one body leaves of any of these recordings [rad].
double one_body_gap(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts) {
  double gap = 0.0;
  for (std::size_t i = 0; i < facts.size(); ++i)
    if (facts[i].defect.empty() && gap < kInfinity)
      gap = std::max(gap, one_body_visible_gap(recordings[i], facts[i]));
  return gap;
}

bool agree(const GapEvidence& a, const GapEvidence& b) {
  return std::abs(a.gap - b.gap) <= kNormal95 * std::hypot(a.parts.together(), b.parts.together());
}

/// Behind most reversals an impact ends the motor's way alone before the torque rises: that is no shelf then,
/// but a load that was thrown on and is met where it stopped.
bool hits_before(const Pool& pool, const GapEvidence& shelf) {
  std::size_t before = 0;
  for (const GapEvent& rise : shelf.events)
    before += std::ranges::any_of(pool.events, [&](const GapEvent& e) {
      const double way = rise.direction * (e.x1_t2 - rise.x1_t1);
      return e.file == rise.file && e.direction == rise.direction && e.t2 > rise.t1 && e.t2 < rise.t2 &&
             way < (1.0 - kSameShelf) * rise.gap_uncorrected;
    });
  return 2 * before > shelf.events.size();
}

/// Whether nothing was read of recordings in which something could have been.
bool may_deny(const Pool& pool, const GapEvidence& evidence) {
  return !evidence.against.empty() && pool.half_periods > 0.0;
}

}  // namespace

GapEstimate decide_gap(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                       std::span<const ImpactAnalysis> analyses, const LoopSearch& loops,
                       const DetectorOptions& options) {
  std::vector<double> intervals;
  for (const MotorTrace& recording : recordings) intervals.push_back(recording.dt);
  const Pool pool = pool_of(analyses, intervals);
  GapEvidence passages = gap_evidence(pool);
  auto shelf = !options.locked && options.method == DetectorMethod::kAuto ? read_shelf(recordings, facts)
                                                                          : std::nullopt;
  if (shelf && hits_before(pool, *shelf)) shelf.reset();
  if (shelf && passages.against.empty() && passages.quantity == GapQuantity::kGap)
    passages.tested.push_back({words::same_by_torque(), agree(passages, *shelf)});
  GapEstimate estimate = conclude(passages);
  if (estimate.verdict == GapVerdict::kBacklash) return estimate;
  if (shelf) return conclude(std::move(*shelf));
  if (!options.locked && !pool.load_is_pushed() && pool.load_rests())
    if (auto together = read_pooled(recordings, facts)) return conclude(std::move(*together));
  const bool ask_loop = options.method == DetectorMethod::kAuto && (loops.decides || options.locked);
  if (loops.found && ask_loop)
    return conclude(options.locked ? loops.found->evidence : loops.found->undeclared());
  if (may_deny(pool, passages))
    estimate = conclude(denial(pool, one_body_gap(recordings, facts), std::move(passages)));
  if (options.locked) speak_of_locked_output(loops, estimate);
  return estimate;
}

GapEstimate decide_by_loop(const LoopSearch& loops, bool locked) {
  if (loops.found) return conclude(locked ? loops.found->evidence : loops.found->undeclared());
  GapEvidence none;
  none.method = GapMethod::kLostMotion;
  none.quantity = GapQuantity::kPlayAtZeroTorque;
  none.against = words::no_loop(loops.why_not);
  return conclude(std::move(none));
}

GapEstimate decide_stream(const ImpactAnalysis& analysis, double dt) {
  const Pool pool = pool_of({&analysis, 1}, {&dt, 1});
  GapEvidence passages = gap_evidence(pool);
  if (may_deny(pool, passages)) passages = denial(pool, analysis.one_body_gap, std::move(passages));
  return conclude(std::move(passages));
}

}  // namespace gapscope::internal::sliding_mode
