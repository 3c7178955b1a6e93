#include "sliding_mode/verdict/loop_verdict.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gapscope/base/statistics.h"
#include "sliding_mode/verdict/informative.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

using Levels = std::span<const TorqueLevel>;

constexpr double kMostly = 0.5;   ///< share of P over which x1 runs free, at least
constexpr double kNowhere = 0.2;  ///< share of P up to which a free run is none
constexpr double kAlone = 2.0;    ///< the free run over the next largest move of a branch, at least
constexpr double kLeaps = 1.5;    ///< x1 runs free over more than this share of P: it leaps elsewhere too

bool any(Levels levels, bool (TorqueLevel::*is)() const) {
  return std::ranges::any_of(levels, [&](const TorqueLevel& level) { return (level.*is)(); });
}
bool all(Levels levels, bool (TorqueLevel::*is)() const) {
  return std::ranges::all_of(levels, [&](const TorqueLevel& level) { return (level.*is)(); });
}

std::vector<words::Play> plays_of(Levels levels) {
  std::vector<words::Play> plays;
  for (const TorqueLevel& level : levels)
    plays.push_back({level.play(), level.amplitude, level.reading.ramps});
  return plays;
}

bool disagree(const TorqueLevel& a, const TorqueLevel& b) {
  return std::abs(a.play() - b.play()) > 2.0 * std::hypot(a.std(), b.std());
}

bool any_disagree(Levels levels) {
  for (const TorqueLevel& a : levels)
    for (const TorqueLevel& b : levels)
      if (disagree(a, b)) return true;
  return false;
}

/// Limit that one level sets: a gap cannot exceed P, and would have stood out where nothing runs free. A P
/// that was read below 0 limits a gap by its error alone.
double limit_of(const TorqueLevel& level) {
  const double most =
      std::max(std::max(level.play(), 0.0) + kSurely * level.std(), kFinest * level.resolution);
  return level.runs_nowhere() ? std::min(most, level.shape.visible) : most;
}

struct GapLimit {
  double gap = kInfinity, amplitude = kNaN;  ///< [rad]; of the ramps that set it [unit of u]
};

/// Limit on a gap from all levels. Ramps that do not overcome the friction pass no gap: where the levels
/// disagree, those without a free run count only by the largest of them.
GapLimit limit_of(Levels levels) {
  const bool apart = any_disagree(levels);
  GapLimit least, largest{0.0};
  for (const TorqueLevel& level : levels) {
    const GapLimit own{limit_of(level), level.amplitude};
    if ((!apart || level.runs()) && own.gap < least.gap) least = own;
    if (own.gap > largest.gap) largest = own;
  }
  return std::isfinite(least.gap) ? least : largest;
}

/// Why levels without a play do not deny a gap; empty where they do.
Remark doubt(Levels levels, double visible) {
  if (any(levels, &TorqueLevel::leaps)) return words::sticks_and_leaps();
  if (any(levels, &TorqueLevel::runs_free))
    return words::free_run_without_play(plays_of(levels), levels.front().shape.sure_run);
  double travel = kInfinity, resolution = 0.0;  // where the motor stands still, nothing shows
  for (const TorqueLevel& level : levels) {
    travel = std::min(travel, level.shape.travel);
    resolution = std::max(resolution, level.resolution);
  }
  if (!(visible < travel)) return words::small_ramps(travel, visible);
  if (!all(levels, &TorqueLevel::runs_nowhere)) return words::sticks_and_leaps();
  if (is_informative(visible, travel, kFinest * resolution)) return {};
  return words::hysteresis_hides(plays_of(levels), visible, travel);
}

/// Why the loops read no play, or deny a gap; nothing speaks against one that all levels show.
void decide(Levels levels, GapEvidence& e) {
  const bool leaps = any(levels, &TorqueLevel::leaps);
  if (any(levels, &TorqueLevel::runs_backwards)) {
    e.against = words::loop_runs_backwards(plays_of(levels));
  } else if (any_disagree(levels)) {
    e.against = words::play_depends_on_level(plays_of(levels), e.smallest_visible_gap);
  } else if (all(levels, &TorqueLevel::shows_play)) {
    e.smallest_visible_gap = levels.front().shape.visible;
    if (levels.size() == 1) e.warnings.push_back(words::play_at_one_level());
    e.reading = words::play_read(plays_of(levels), levels.front().shape.free_run);
  } else if (any(levels, &TorqueLevel::shows_play)) {
    e.against = leaps ? words::sticks_and_leaps() : words::play_at_some_levels();
  } else if (any(levels, &TorqueLevel::runs) && !leaps) {
    e.against = words::play_scatters(plays_of(levels), levels.front().reading.half_width);
  } else {
    e.against = doubt(levels, e.smallest_visible_gap);
    e.denies = e.against.empty();
    if (e.denies) e.reading = words::no_free_run(plays_of(levels));
  }
}

/// One number: of the levels together where they agree, weighted by their precision; else of the smallest
/// torque.
LostMotion measured(Levels levels) {
  LostMotion m;
  for (const TorqueLevel& l : levels) {
    const double half = l.reading.half_width;
    m.levels.push_back({l.amplitude,
                        l.play(),
                        {l.play() - half, l.play() + half},
                        l.reading.ramps,
                        l.shape.free_run,
                        l.shape.flank});
  }
  const Levels used = any_disagree(levels) ? levels.first(1) : levels;
  double sum = 0.0, weights = 0.0;
  for (const TorqueLevel& l : used) {
    const double weight = 1.0 / std::max(l.reading.half_width * l.reading.half_width, 1e-30);
    sum += weight * l.play(), weights += weight;
  }
  m.value = sum / weights;
  const double half = 1.0 / std::sqrt(weights);
  m.ci95 = {m.value - half, m.value + half};
  // A loop that u is late for bounds nothing.
  const GapLimit limit = limit_of(levels);
  if (std::isfinite(limit.gap) && !any(levels, &TorqueLevel::runs_backwards))
    m.gap_limit = limit.gap, m.limit_amplitude = limit.amplitude;
  return m;
}

/// What speaks for a gap, and what for friction and compliance.
void explain(Levels levels, LostMotion& m) {
  const bool apart = any_disagree(levels);
  const bool known = std::ranges::all_of(
      levels, [](const TorqueLevel& l) { return l.reading.half_width <= kWidest * l.play(); });
  const bool still = all(levels, &TorqueLevel::runs_nowhere) && !any(levels, &TorqueLevel::runs_free) &&
                     !any(levels, &TorqueLevel::leaps) && !any(levels, &TorqueLevel::runs_backwards);
  m.cause = LostMotionCause::kOpen;
  if (all(levels, &TorqueLevel::runs) && !any(levels, &TorqueLevel::leaps) && known)
    m.cause = LostMotionCause::kGap;
  else if (still &&
           std::ranges::all_of(levels, [](const TorqueLevel& l) { return l.play() > l.reading.half_width; }))
    m.cause = LostMotionCause::kFriction;
  m.meaning = words::lost_motion_means(m.cause, m.levels.front().free_run, levels.front().shape.alone, apart);
}

}  // namespace

bool TorqueLevel::runs() const {
  return shape.free_run >= kMostly * play() && shape.alone >= kAlone && play() > kFinest * resolution;
}
bool TorqueLevel::shows_play() const { return runs() && !leaps() && reading.half_width <= kWidest * play(); }
bool TorqueLevel::leaps() const { return shape.free_run > kLeaps * play() && play() > kFinest * resolution; }
bool TorqueLevel::runs_nowhere() const {
  return shape.free_run <= kNowhere * std::max(play(), kFinest * resolution);
}
bool TorqueLevel::runs_free() const { return shape.sure_run >= shape.stands_out; }
bool TorqueLevel::runs_backwards() const { return play() + kSurely * std() < 0.0; }

void hold_against_gap(GapEstimate& estimate) {
  LostMotion& m = estimate.lost_motion;
  const bool gap = estimate.verdict == GapVerdict::kBacklash && estimate.quantity == GapQuantity::kGap;
  if (!gap || !m.read() || !(estimate.ci95.high < kMostly * m.value)) return;
  m.cause = LostMotionCause::kOpen;
  m.meaning = words::holds_gap(m.value, estimate.gap);
}

GapEvidence LoopEvidence::undeclared() const {
  GapEvidence e = evidence;
  if (lost_motion.levels.size() > 1 || e.denies || !e.against.empty()) return e;
  e.against = words::play_is_a_bound(lost_motion.gap_limit);
  e.warnings.clear();
  return e;
}

LoopEvidence loop_evidence(Levels levels) {
  LoopEvidence found;
  found.lost_motion = measured(levels);
  explain(levels, found.lost_motion);
  GapEvidence& e = found.evidence;
  e.method = GapMethod::kLostMotion;
  e.quantity = GapQuantity::kPlayAtZeroTorque;
  e.gap = found.lost_motion.value;
  e.parts.random = (found.lost_motion.ci95.high - found.lost_motion.ci95.low) / (2.0 * kSurely);
  e.smallest_visible_gap = found.lost_motion.gap_limit;
  decide(levels, e);
  e.tested = {{words::levels_agree(), levels.size() > 1 && e.against.empty()}};
  return found;
}

}  // namespace gapscope::internal::sliding_mode
