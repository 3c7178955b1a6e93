#include "sliding_mode/verdict/pool.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "gapscope/base/statistics.h"
#include "signals/encoder.h"
#include "sliding_mode/visible_gap.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kStriking = 2.5;  ///< contrast from which on a passage is not that of friction

constexpr std::size_t kFewest = 2;        ///< passages in each direction
constexpr std::size_t kFewestOneWay = 5;  ///< where only one direction shows any
constexpr double kMost = 0.6;             ///< of the half periods, and of what looks like a passage

/// Of the passages. 0.2 withholds two right readings (871011, 871106 gap sine: 0.54); 1 tells nothing more.
constexpr double kFewMovingLoads = 0.6;

std::vector<double> gaps_of(const std::vector<const Passage*>& passages, int direction) {
  std::vector<double> gaps;
  for (const Passage* p : passages)
    if (direction == 0 || p->event.direction == direction) gaps.push_back(p->event.gap);
  return gaps;
}

template <class Member>
double median_of(const Pool& pool, Member member) {
  std::vector<double> values;
  for (const Passage* p : pool.accepted) values.push_back(p->*member);
  return median(std::move(values));
}

std::size_t in(const std::map<int, std::size_t>& counts, int direction) {
  if (direction == 0) return in(counts, 1) + in(counts, -1);
  const auto found = counts.find(direction);
  return found == counts.end() ? 0 : found->second;
}

/// What the accepted passages say: of both directions, or of the one that alone shows the gap, where an
/// unsymmetrical motion does so one way only.
struct Middle {
  int only = 0;  ///< that direction; 0: both
  std::size_t used = 0;
  double up = kNaN, down = kNaN, gap = kNaN, apart = 0.0, scatter = 0.0;  ///< [rad]
};

Middle middle_of(const std::vector<const Passage*>& passages) {
  Middle m;
  const std::vector<double> up = gaps_of(passages, 1), down = gaps_of(passages, -1);
  if (std::min(up.size(), down.size()) < kFewest && std::max(up.size(), down.size()) >= kFewestOneWay)
    m.only = up.size() > down.size() ? 1 : -1;
  m.used = m.only > 0 ? up.size() : m.only < 0 ? down.size() : up.size() + down.size();
  m.up = up.empty() ? kNaN : median(up), m.down = down.empty() ? kNaN : median(down);
  m.gap = m.only > 0 ? m.up : m.only < 0 ? m.down : 0.5 * (m.up + m.down);
  m.apart = m.only == 0 ? std::abs(m.up - m.down) : 0.0;
  m.scatter = std::max(m.only >= 0 ? robust_std(up) : 0.0, m.only <= 0 ? robust_std(down) : 0.0);
  return m;
}

/// A gap is passed in most half periods, and most of what looks like a passage is one. Those in the rebound
/// of an impact, and those without an abrupt end, say nothing for or against.
double fewest_passages(const Pool& pool, int direction) {
  const double half_periods = direction == 0 ? pool.half_periods : 0.5 * pool.half_periods;
  const auto candidates = static_cast<double>(in(pool.passages, direction) - in(pool.mute, direction));
  return std::ceil(kMost * std::max(half_periods, candidates));
}

/// Why the accepted passages do not make a reading; empty if they do.
Remark objection(const Pool& pool, const Middle& m) {
  const std::size_t plus = gaps_of(pool.accepted, 1).size(), minus = pool.accepted.size() - plus;
  if (m.only == 0 && std::min(plus, minus) < kFewest)
    return words::few_passages_each_way(static_cast<long>(plus), static_cast<long>(minus),
                                        advice(pool.commonest()));
  const double asked = fewest_passages(pool, m.only);
  if (static_cast<double>(m.used) < asked)
    return words::few_passages(std::ssize(pool.accepted), asked, static_cast<long>(pool.seen()),
                               pool.half_periods, advice(pool.commonest()));
  if (m.gap > kMostOfTravel * pool.travel) return words::most_of_travel(m.gap, pool.travel);
  if (m.gap < signals::kFewestToldQuanta * pool.quantum)
    return words::gap_few_quanta(m.gap, m.gap / pool.quantum);
  return {};
}

/// Half of what the recordings disagree by that show the gap each by itself [rad].
double recordings_disagreement(const std::vector<const Passage*>& passages) {
  std::map<std::string, std::vector<const Passage*>> of_files;
  for (const Passage* p : passages) of_files[p->event.file].push_back(p);
  double low = kInfinity, high = -kInfinity;
  for (const auto& [file, own] : of_files) {
    const std::size_t up = gaps_of(own, 1).size();
    if (std::min(up, own.size() - up) < kFewest) continue;
    const double gap = middle_of(own).gap;
    low = std::min(low, gap), high = std::max(high, gap);
  }
  return std::max(0.5 * (high - low), 0.0);
}

/// Whether the motor rested at its load before most passages, or the law of the load is known.
bool load_known(const Pool& pool) {
  const auto known = std::ranges::count_if(
      pool.accepted, [](const Passage* p) { return (p->dwell || p->by_law) && !p->untold; });
  return 2 * known >= std::ssize(pool.accepted);
}

/// Over the impact: a mark behind it that is more abrupt is no bounce of it, which has lost of its speed, but
/// another impact: that of a second gap. Of 105 drives of another simulator with one gap that are
/// read no median is beyond 1, of 14 with two gaps 11 are; half takes 33 of the former, double none.
constexpr double kBounces = 1.0;

/// What x1 goes until the last of several gaps in series is closed, where most passages show a second impact
/// [rad]; else NaN.
double to_second_impact(const Pool& pool) {
  if (!(median_of(pool, &Passage::later) > kBounces)) return kNaN;
  std::vector<double> ways;
  for (const Passage* p : pool.accepted)
    if (std::isfinite(p->to_later)) ways.push_back(p->to_later + p->load_travel);
  const double whole = median(std::move(ways));
  return whole < kMostOfTravel * pool.travel ? whole : kNaN;  // there the stroke itself ends
}

/// No gap is larger than what most half periods show; the upper quartile, for one that is none.
double at_most(const Pool& pool) {
  if (static_cast<double>(pool.largest.size()) < kMost * pool.half_periods) return kNaN;
  std::vector<double> all = pool.largest;
  const auto upper = all.begin() + static_cast<std::ptrdiff_t>(3 * all.size() / 4);
  std::nth_element(all.begin(), upper, all.end());
  return *upper;
}

Deviations deviations(const Pool& pool, const Middle& m) {
  const double witnesses = (m.only == 0 ? 0.5 : 1.0) * static_cast<double>(m.used);
  return {m.scatter / std::sqrt(std::max(witnesses, 1.0)),
          0.5 * m.apart,
          recordings_disagreement(pool.accepted),
          median_of(pool, &Passage::half_width) / kNormal95,  // alike in all passages, and of 95 %
          0.25 * median_of(pool, &Passage::speed) * pool.dt,
          pool.noise};
}

}  // namespace

std::size_t Pool::seen() const { return in(passages, 0); }

Refusal Pool::commonest() const {
  const auto most = std::ranges::max_element(refused, {}, [](const auto& counted) { return counted.second; });
  return most == refused.end() ? Refusal::kNone : most->first;
}

bool Pool::load_is_pushed() const {
  const auto pushed = refused.find(Refusal::kPushed);
  return pushed != refused.end() && 2 * pushed->second > seen();
}

bool Pool::load_rests() const {
  std::size_t moving = 0;
  for (const auto& [why, count] : refused)
    if (speaks_of_moving_load(why)) moving += count;
  return static_cast<double>(moving) <= kFewMovingLoads * static_cast<double>(seen());
}

Pool pool_of(std::span<const ImpactAnalysis> analyses, std::span<const double> intervals) {
  Pool pool;
  for (std::size_t i = 0; i < analyses.size(); ++i) {
    const ImpactAnalysis& a = analyses[i];
    if (!a.facts.defect.empty()) {
      if (pool.defect.empty()) pool.defect = a.facts.defect;
      continue;
    }
    pool.half_periods += static_cast<double>(a.facts.half_periods);
    pool.travel = std::min(pool.travel, a.facts.travel);
    pool.noise = std::max(pool.noise, a.facts.noise);
    pool.quantum = std::max(pool.quantum, a.facts.quantum);
    pool.dt = std::max(pool.dt, intervals[i]);
    pool.leaning = std::min(pool.leaning, a.facts.leaning);
    pool.visible = std::max(pool.visible, a.smallest_visible_gap);
    pool.finest = std::max(pool.finest, a.finest_gap);
    pool.encoder = std::max(pool.encoder, encoder_visible_gap(a.facts));
    pool.marks += a.marks;
    for (const Passage& p : a.passages) {
      pool.events.push_back(event_of(p));
      ++pool.passages[p.event.direction];
      pool.mute[p.event.direction] += says_nothing(p.refusal);
      pool.striking += p.contrast >= kStriking;
      if (std::isfinite(p.most)) pool.largest.push_back(p.most);
      if (p.refusal == Refusal::kNone)
        pool.accepted.push_back(&p);
      else
        ++pool.refused[p.refusal];
    }
  }
  return pool;
}

GapEvidence gap_evidence(const Pool& pool) {
  GapEvidence e;
  e.quantum = pool.quantum;
  e.smallest_visible_gap = pool.half_periods > 0.0 && std::isfinite(pool.visible) ? pool.visible : kNaN;
  e.events = pool.events;
  const Middle m = middle_of(pool.accepted);
  e.against = pool.half_periods > 0.0 ? objection(pool, m)
              : pool.defect.empty()   ? words::no_recording()
                                      : pool.defect;
  if (pool.half_periods > 0.0) e.at_most = at_most(pool);
  if (!e.against.empty()) return e;
  e.gap = m.gap;
  e.parts = deviations(pool, m);
  const bool both = m.only == 0 && e.parts.directions <= kNormal95 * e.parts.beside_directions();
  e.tested = {{words::both_directions(), both},
              {words::single_passages(), true},
              {words::load_known(), load_known(pool)}};
  e.presumes = {words::own_encoder()};
  e.reading = words::passages_used(static_cast<long>(m.used), static_cast<long>(pool.seen()), m.only);
  e.whole = to_second_impact(pool);
  e.tested.push_back({words::one_impact(), std::isnan(e.whole)});
  if (std::isfinite(e.whole))
    e.quantity = GapQuantity::kFirstGap, e.reading += words::second_impact();
  else
    e.presumes.insert(e.presumes.begin(), words::one_gap());
  e.smallest_visible_gap = pool.finest < m.gap ? pool.finest : kNaN;  // it foretells, this one shows
  return e;
}

}  // namespace gapscope::internal::sliding_mode
