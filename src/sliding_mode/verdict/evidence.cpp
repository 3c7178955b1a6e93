#include "sliding_mode/verdict/evidence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/normal.h"
#include "sliding_mode/verdict/pool.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

/// What an interval that is too wide is mostly made of, and what would narrow it. Where contact is lost and
/// regained is read to a count or so, of which also the directions differ: twice as many counts in the gap
/// halve it.
/// @param excess of the interval over the widest that is told
Remark mostly(const GapEvidence& e, double excess) {
  const Deviations& d = e.parts;
  const double most = std::max({d.random, d.directions, d.recordings, d.systematic, d.sampling, d.noise});
  const double counts = e.gap / e.quantum;
  if (most == d.random) return words::passages_differ();
  if (most == d.sampling) return words::samples_apart();
  if (most == d.recordings) return words::recordings_differ();
  if (counts < kFineGap) return words::few_counts(counts, excess * counts);
  return most == d.directions ? words::directions_differ() : words::ends_uncertain();
}

}  // namespace

double Deviations::together() const {
  double sum = 0.0;
  for (const double d : {random, directions, recordings, systematic, sampling, noise}) sum += d * d;
  return std::sqrt(sum);
}

double Deviations::beside_directions() const {
  Deviations others = *this;
  others.directions = 0.0;
  return others.together();
}

GapEstimate conclude(GapEvidence e) {
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.method = e.method;
  estimate.quantity = e.quantity;
  estimate.smallest_visible_gap = e.smallest_visible_gap;
  estimate.events = std::move(e.events);
  estimate.warnings = std::move(e.warnings);
  estimate.tested = std::move(e.tested);
  estimate.presumes = std::move(e.presumes);
  estimate.reason = e.denies ? e.reading : e.against;
  if (e.denies) {
    estimate.verdict = GapVerdict::kNone;
    estimate.gap_at_most = e.smallest_visible_gap;
    estimate.trust = GapTrust::kLimited;  // a load that is lighter, or held by what pulls, would not show
  }
  if (!e.denies) estimate.gap_at_most = e.at_most;
  if (!estimate.reason.empty()) return estimate;
  const double std = e.parts.together(), share = kNormal95 * std / e.gap;
  const Remark uncertain = words::gap_uncertain(e.gap, 100.0 * share, mostly(e, share / kNarrow));
  if (!(share <= kWidest)) {
    estimate.reason = uncertain;
    return estimate;
  }
  const bool narrow = share <= kNarrow;
  if (e.quantity == GapQuantity::kGap) estimate.tested.push_back({words::narrow_interval(), narrow});
  if (e.quantity == GapQuantity::kGap && !narrow) estimate.warnings.push_back(uncertain);
  const bool all = std::ranges::all_of(estimate.tested, &ReadingTest::passed);
  estimate.trust = all && e.quantity == GapQuantity::kGap ? GapTrust::kGood : GapTrust::kLimited;
  estimate.verdict = GapVerdict::kBacklash;
  estimate.gap_at_most = kNaN;  // the interval says more
  estimate.gap = e.gap;
  estimate.whole = e.whole;
  estimate.std = std;
  estimate.ci95 = {std::max(e.gap - kNormal95 * std, 0.0), e.gap + kNormal95 * std};
  estimate.reason = e.reading;
  return estimate;
}

std::optional<GapEvidence> narrowest(std::span<const MotorTrace> recordings,
                                     std::span<const signals::SignalFacts> facts,
                                     std::optional<GapEvidence> (*read)(const MotorTrace&,
                                                                        const signals::SignalFacts&)) {
  std::optional<GapEvidence> best;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    auto one = read(recordings[i], facts[i]);
    if (!one || kNormal95 * one->parts.together() > kWidest * one->gap) continue;
    const double std = one->parts.together(), known = best ? best->parts.together() : kInfinity;
    if (best && std::abs(one->gap - best->gap) > kNormal95 * (std + known)) return {};
    if (std < known) best = std::move(one);
  }
  return best;
}

}  // namespace gapscope::internal::sliding_mode
