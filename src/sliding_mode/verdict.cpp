#include "sliding_mode/verdict.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "gapscope/base/normal.h"
#include "gapscope/base/statistics.h"
#include "signals/encoder.h"
#include "signals/folding.h"
#include "sliding_mode/deviations.h"
#include "sliding_mode/informative.h"
#include "sliding_mode/told_events.h"
#include "sliding_mode/visible_gap.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kVisible = 0.4;      ///< of the travel, from which on a gap could not have been seen
constexpr double kStriking = 2.5;     ///< contrast from which on a passage is not that of friction
constexpr double kFewStriking = 0.3;  ///< of the half periods

/// Standard deviation, over the half width of a passage: in gaps below kFineGap quanta or behind a soft
/// contact, and in others. Of the 78 others of 871001 150 gap sine, 3391001 60 gap trapezoid and 3376001 60
/// gap multisine intervals hold 77 with 0.53, 76 with 0.43, 73 with 0.27; with 0.86 all hold and five are too
/// wide to be told.
constexpr double kSystematic = 0.53, kSystematicFine = 0.43;
/// Standard deviation of a gap that a mean period shows, over that of one read from samples. Set on
/// study_sliding_mode 2100001 200 gap sine (with sums of samples): with 1 intervals hold 19 of 23, with 1.25
/// 18 of 19 (four are too wide to be told).
constexpr double kSummed = 1.25;
constexpr double kWidest = 0.095;  ///< of the 95 % interval of a gap that is reported, either way

constexpr std::size_t kFewest = 2;        ///< passages in each direction
constexpr std::size_t kFewestOneWay = 5;  ///< where only one direction shows any
constexpr double kMost = 0.6;             ///< of the half periods, and of what looks like a passage

/// Of a gap, that the motor may go on before its impact shows. Four of 871001 150 gap sine and 3376001 60 gap
/// multisine that 0.07 withheld read -0.3 to 3.6 % off, within their intervals, where these are narrow enough
/// to be told; beyond 0.12 they are not (871114, 871058). From kSoft on, they stay as wide as those of coarse
/// encoders: of 101 told (of 4100001 600 gap sine and 4310001 120 gap sine wide) half and double change 12
/// intervals, by up to a fifth; all 101 hold either way, and none becomes too wide to be told.
constexpr double kMostHidden = 0.12, kSoft = 0.07;
constexpr double kMostOfTravel = 0.8;    ///< largest gap, as a share of the travel
constexpr double kFarthest = 2.0;        ///< that a load may travel, in gaps, if the rest is to be a gap
constexpr double kLeastMoving = 0.1;     ///< … from which on one direction alone is not believed
constexpr double kFewTravel = 0.3;       ///< … within fewer quanta than kFewestMoving
constexpr double kFewMoving = 0.2;       ///< passages refused for it, over those that are used
constexpr double kFewestMoving = 100.0;  ///< quanta in a gap within which the load travels far

struct Pool {
  std::vector<const Transition*> accepted;
  std::map<Refusal, int> refused;       // ordered: the same text for the same data
  std::map<int, std::size_t> passages;  // by direction
  std::map<int, std::size_t> mute;      // of them, that say nothing for or against a gap
  double travel = kInfinity, dt = 0.0, noise = 0.0, half_periods = 0.0, visible = 0.0, one_body = 0.0,
         finest = 0.0, encoder = 0.0, quantum = 0.0;
  std::size_t events = 0;
  bool repeats = false;      // mean periods
  std::size_t striking = 0;  // passages
};

std::vector<double> gaps_of(const Pool& pool, int direction) {
  std::vector<double> gaps;
  for (const Transition* t : pool.accepted)
    if (direction == 0 || t->event.direction == direction) gaps.push_back(t->event.gap);
  return gaps;
}

template <class Member>
double median_of(const Pool& pool, Member member) {
  std::vector<double> values;
  for (const Transition* t : pool.accepted) values.push_back(t->*member);
  return median(std::move(values));
}

/// For or against a gap.
bool says_nothing(Refusal refusal) {
  return refusal == Refusal::kThrownOff || refusal == Refusal::kContrast || refusal == Refusal::kSameFlank;
}

Pool collect(std::span<const ImpactAnalysis> analyses, std::span<const double> intervals) {
  Pool pool;
  for (std::size_t i = 0; i < analyses.size(); ++i) {
    const ImpactAnalysis& a = analyses[i];
    if (!a.facts.defect.empty()) continue;
    pool.half_periods += static_cast<double>(a.facts.half_periods);
    pool.travel = std::min(pool.travel, a.facts.travel);
    pool.noise = std::max(pool.noise, a.facts.noise);
    pool.quantum = std::max(pool.quantum, a.quantum);
    pool.dt = std::max(pool.dt, intervals[i]);
    pool.visible = std::max(pool.visible, a.smallest_visible_gap);
    pool.finest = std::max(pool.finest, a.finest_gap);
    pool.encoder = std::max(pool.encoder, encoder_visible_gap(a.facts));
    pool.events += a.marks;
    pool.repeats = pool.repeats || a.repeats;
    for (const Transition& t : a.passages) {
      ++pool.passages[t.event.direction];
      pool.mute[t.event.direction] += says_nothing(t.refusal);
      pool.striking += t.contrast >= kStriking;
      if (t.refusal == Refusal::kNone)
        pool.accepted.push_back(&t);
      else
        ++pool.refused[t.refusal];
    }
  }
  return pool;
}

Refusal commonest(const Pool& pool) {
  Refusal refusal = Refusal::kNone;
  int most = 0;
  for (const auto& [r, count] : pool.refused)
    if (count > most) most = count, refusal = r;
  return refusal;
}

std::size_t in(const std::map<int, std::size_t>& counts, int direction) {
  if (direction == 0) return in(counts, 1) + in(counts, -1);
  const auto found = counts.find(direction);
  return found == counts.end() ? 0 : found->second;
}

/// The direction that alone shows the gap, where an unsymmetrical motion does so one way only; 0: both do.
int only_direction(const Pool& pool) {
  const std::size_t plus = gaps_of(pool, 1).size(), minus = gaps_of(pool, -1).size();
  if (pool.repeats || std::min(plus, minus) >= kFewest || std::max(plus, minus) < kFewestOneWay) return 0;
  return plus > minus ? 1 : -1;
}

/// A gap is passed in most half periods, and most of what looks like a passage is one. Those in the rebound
/// of an impact, and those without an abrupt end, say nothing for or against.
double fewest_passages(const Pool& pool, int direction) {
  const double half_periods = direction == 0 ? pool.half_periods : 0.5 * pool.half_periods;
  const auto candidates = static_cast<double>(in(pool.passages, direction) - in(pool.mute, direction));
  return std::ceil(kMost * std::max(half_periods, candidates));
}

/// The estimate, and half of what the directions disagree by.
struct Middle {
  double gap, disagreement;
};

Middle middle(const Pool& pool) {
  const int only = only_direction(pool);
  if (only != 0) return {median(gaps_of(pool, only)), 0.0};
  const double up = median(gaps_of(pool, 1)), down = median(gaps_of(pool, -1));
  return {0.5 * (up + down), 0.5 * std::abs(up - down)};
}

/// Robust standard deviation of one passage, in the direction that scatters more.
double scatter(const Pool& pool) {
  const int only = only_direction(pool);
  if (only != 0) return robust_std(gaps_of(pool, only));
  return std::max(robust_std(gaps_of(pool, 1)), robust_std(gaps_of(pool, -1)));
}

/// Farther than one can tell how far the load went. Where its law tells, the doubt of that is in the
/// interval: 10.3 gaps are read 0.5 % off (4100039 gap sine).
bool travels_too_far(const Pool& pool, double gap, int only) {
  const double moved = std::abs(median_of(pool, &Transition::load_travel));
  const auto by_law = std::ranges::count_if(pool.accepted, &Transition::by_law);
  if (2 * by_law > std::ssize(pool.accepted)) return false;
  return moved > kFarthest * gap || (only != 0 && moved > kLeastMoving * gap) ||
         (moved > kFewTravel * gap && gap < kFewestMoving * pool.quantum);
}

/// Why the accepted passages do not make an estimate; empty if they do.
Remark objection(const Pool& pool) {
  const auto plus = gaps_of(pool, 1), minus = gaps_of(pool, -1);
  const int only = only_direction(pool);
  if (only == 0 && (plus.size() < kFewest || minus.size() < kFewest))
    return words::few_passages_each_way(std::ssize(plus), std::ssize(minus), advice(commonest(pool)));
  const double asked = fewest_passages(pool, only);
  if (static_cast<double>(gaps_of(pool, only).size()) < asked)
    return words::few_passages(std::ssize(pool.accepted), asked, static_cast<long>(in(pool.passages, 0)),
                               pool.half_periods, advice(commonest(pool)));
  const auto [gap, disagreement] = middle(pool);
  const double spread = scatter(pool);
  if (spread > 0.25 * gap) return words::passages_scatter(100.0 * spread / gap);
  if (2.0 * disagreement > 0.25 * gap) return words::directions_contradict(median(plus), median(minus));
  if (gap > kMostOfTravel * pool.travel) return words::most_of_travel(gap, pool.travel);
  const double few_moving = kFewMoving * static_cast<double>(pool.accepted.size());
  for (const auto& [why, passages] : pool.refused)
    if ((why == Refusal::kLoadMoving || why == Refusal::kPushed) && passages > few_moving) return advice(why);
  if (travels_too_far(pool, gap, only)) return advice(Refusal::kLoadMoving);
  if (gap < signals::kFewestToldQuanta * pool.quantum) return words::gap_few_quanta(gap, gap / pool.quantum);
  const double hidden = median_of(pool, &Transition::hidden);
  if (hidden > kMostHidden * gap) return words::soft_contact(100.0 * hidden / gap);
  return {};
}

/// No impact stands out, although every stroke left its marks, and there are gaps whose impacts would be more
/// abrupt than all of these. Friction that turns round may stand out a little.
bool shows_nothing(const Pool& pool) {
  return static_cast<double>(pool.striking) < kFewStriking * pool.half_periods &&
         static_cast<double>(pool.events) >= 0.5 * pool.half_periods && pool.visible < kVisible * pool.travel;
}

/// What could have been shown, and with which load.
Remark limit_of(const Pool& pool) {
  const bool as_one_body = pool.one_body < pool.visible;
  return words::only_large_gaps(as_one_body ? kLightestLoad : kSmallestMassRatio,
                                std::min(pool.one_body, pool.visible), pool.travel);
}

/// Nothing was seen because nothing could have been seen.
bool too_slow(const Pool& pool) {
  const Refusal refusal = commonest(pool);
  return pool.accepted.empty() && pool.visible >= kVisible * pool.travel &&
         (refusal == Refusal::kContrast || refusal == Refusal::kNone);
}

Deviations deviations(const Pool& pool, double gap, double disagreement) {
  const int only = only_direction(pool);
  // The passages of a mean period come again in each of its copies: they are no more witnesses for that.
  const double witnesses =
      static_cast<double>(gaps_of(pool, only).size()) / (pool.repeats ? signals::FoldedMotion::kTiles : 1.0);
  const bool coarse = gap < kFineGap * pool.quantum || median_of(pool, &Transition::hidden) > kSoft * gap;
  return {scatter(pool) / std::sqrt(std::max((only == 0 ? 0.5 : 1.0) * witnesses, 1.0)),
          disagreement,
          recordings_disagreement(pool.accepted, kFewest),
          (coarse ? kSystematic : kSystematicFine) * median_of(pool, &Transition::half_width),
          0.25 * median_of(pool, &Transition::speed) * pool.dt,
          pool.noise};
}

void fill_estimate(const Pool& pool, GapEstimate& estimate) {
  const int only = only_direction(pool);
  const auto [gap, disagreement] = middle(pool);
  const Deviations parts = deviations(pool, gap, disagreement);
  estimate.verdict = GapVerdict::kBacklash;
  estimate.smallest_visible_gap = pool.finest < gap ? pool.finest : kNaN;  // it foretells, this one shows
  estimate.gap = gap;
  estimate.std = (pool.repeats ? kSummed : 1.0) * parts.together();
  estimate.ci95 = {std::max(estimate.gap - kNormal95 * estimate.std, 0.0),
                   estimate.gap + kNormal95 * estimate.std};
  estimate.reason =
      words::passages_used(std::ssize(gaps_of(pool, only)), static_cast<long>(in(pool.passages, 0)), only);
  const double share = kNormal95 * estimate.std / gap;
  if (share <= kWidest) return;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.reason =
      words::gap_uncertain(gap, 100.0 * share, mostly(parts, gap / pool.quantum, share / kWidest));
  estimate.gap = estimate.std = kNaN;
  estimate.ci95 = {};
}

}  // namespace

GapEstimate decide_gap(std::span<const ImpactAnalysis> analyses, std::span<const double> intervals) {
  GapEstimate estimate;
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.method = GapMethod::kImpact;
  for (const ImpactAnalysis& a : analyses)
    for (const Transition& t : a.passages) estimate.events.push_back(event_of(t));
  Pool pool = collect(analyses, intervals);
  if (pool.half_periods == 0.0) {
    estimate.reason = analyses.empty() ? words::no_recording() : analyses.front().facts.defect;
    return estimate;
  }
  estimate.smallest_visible_gap = std::isfinite(pool.visible) ? pool.visible : kNaN;
  const Remark against = objection(pool);
  if (against.empty()) {
    fill_estimate(pool, estimate);
    return estimate;
  }
  pool.one_body = one_body_gap(analyses);
  if (is_informative(pool.one_body, pool.travel, pool.encoder)) {
    estimate.verdict = GapVerdict::kNone;  // one body explains the motion: larger gaps would have left more
    estimate.smallest_visible_gap = pool.one_body;
    estimate.reason = words::one_body(kLightestLoad, pool.half_periods);
  } else if (shows_nothing(pool)) {
    estimate.smallest_visible_gap = std::min(pool.one_body, pool.visible);
    estimate.reason = limit_of(pool);
  } else {
    estimate.reason = too_slow(pool) ? words::too_slow(pool.visible) : against;
  }
  return estimate;
}

}  // namespace gapscope::internal::sliding_mode
