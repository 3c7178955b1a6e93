#include "sliding_mode/lost_motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gapscope/base/statistics.h"
#include "signals/torque_cycles.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kFollowing = 0.9;  ///< least share of the travel that goes with the change of u
constexpr double kSameLevel = 1.3;  ///< amplitudes within this factor are one level
constexpr std::size_t kBins = 20;   ///< of a branch, over twice the amplitude
constexpr double kFree = 10.0;      ///< compliance where x1 runs free, over that of the flank
constexpr double kMostly = 0.5;     ///< share of the play over which x1 runs free, at least
constexpr double kLeaps =
    1.5;  ///< x1 runs free over more than this share of the play: it leaps elsewhere too
constexpr double kFinest = 30.0;  ///< smallest play that is read, in standard deviations of one position
constexpr double kSurely = 1.96;  ///< standard errors of a play to either side: 95 %
constexpr std::size_t kFewestLoops = 2;

/// Two successive zeros of the input.
struct Loop {
  double amplitude = 0.0;  ///< smaller of the two half cycles that it depends on [unit of u]
  GapEvent event;
};

struct Branch {
  double amplitude = 0.0;
  const MotorTrace* trace = nullptr;
  const signals::TorqueCycles* cycles = nullptr;
  std::size_t crossing = 0;
};

/// What the loops of one torque amplitude say.
struct TorqueLevel {
  double amplitude = 0.0;             ///< [unit of u]
  std::vector<double> plays, widths;  ///< of the loops [rad]
  double play = kNaN, std = kNaN;     ///< P and its standard error [rad]
  double free_run = 0.0;              ///< travel over which x1 runs free, median over the branches [rad]
  double sure_run = 0.0;              ///< the same where noise and counting cannot feign it [rad]
  double travel = 0.0;                ///< of x1 on a branch, median over them [rad]
  double visible = kInfinity;         ///< smallest gap that would have stood out [rad]
  double resolution = 0.0;            ///< of one position [rad]
  double least_way = 0.0;             ///< that is surely none of noise and counting [rad]
  bool shows_play() const {
    return free_run >= kMostly * play && free_run <= kLeaps * play && play > kFinest * resolution;
  }
  bool leaps() const { return free_run > kLeaps * play && play > kFinest * resolution; }
  /// As far as a gap that would have stood out: it stood out.
  bool runs_free() const { return sure_run >= visible; }
  /// Friction and gaps lag behind u; only a u that is late itself leads.
  bool runs_backwards() const { return play + kSurely * std < 0.0; }
};

/// The play of each pair of zeros of the input, one after a positive and one after a negative half cycle.
std::vector<Loop> loops_of(const MotorTrace& trace, const signals::TorqueCycles& cycles) {
  std::vector<Loop> loops;
  for (std::size_t i = 1; i < cycles.crossings.size(); ++i) {
    const signals::ZeroCrossing &a = cycles.crossings[i - 1], &b = cycles.crossings[i];
    const double smaller = std::min(a.before, b.before), larger = std::max(a.before, b.before);
    if (a.rising == b.rising || larger > kSameLevel * smaller) continue;
    Loop loop{smaller, {}};
    GapEvent& e = loop.event;
    e.file = trace.file;
    e.t1 = trace.time(a.sample);
    e.t2 = trace.time(b.sample);
    e.x1_t1 = a.x1;
    e.x1_t2 = b.x1;
    e.direction = a.rising ? 1 : -1;  // the ramp between them goes this way
    e.gap = e.direction * (b.x1 - a.x1);
    e.std = std::hypot(a.half_width, b.half_width) / 2.0;
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Branch> branches_of(const MotorTrace& trace, const signals::TorqueCycles& cycles) {
  std::vector<Branch> branches;
  for (std::size_t i = 0; i < cycles.crossings.size(); ++i)
    branches.push_back({std::min(cycles.crossings[i].before, cycles.crossings[i].after), &trace, &cycles, i});
  return branches;
}

bool within(double amplitude, double level) { return amplitude >= level && amplitude <= kSameLevel * level; }

/// Loops by amplitude, the smallest first; loops that are alone at theirs are left out.
std::vector<TorqueLevel> levels_of(std::vector<Loop>& loops) {
  std::sort(loops.begin(), loops.end(),
            [](const Loop& a, const Loop& b) { return a.amplitude < b.amplitude; });
  std::vector<TorqueLevel> levels;
  for (const Loop& loop : loops) {
    if (levels.empty() || !within(loop.amplitude, levels.back().amplitude)) {
      levels.emplace_back();
      levels.back().amplitude = loop.amplitude;
    }
    levels.back().plays.push_back(loop.event.gap);
    levels.back().widths.push_back(loop.event.std);
  }
  std::erase_if(levels, [](const TorqueLevel& level) { return level.plays.size() < kFewestLoops; });
  return levels;
}

/// Range of x1 from one extreme of the input over the next.
double travel_of(const Branch& b) {
  const auto& all = b.cycles->crossings;
  const std::size_t from = b.crossing > 0 ? all[b.crossing - 1].sample : 0;
  const std::size_t to = b.crossing + 1 < all.size() ? all[b.crossing + 1].sample : b.trace->size();
  const auto [low, high] = std::ranges::minmax(b.trace->x1.subspan(from, to - from));
  return high - low;
}

/// Travel within the bins in which x1 moves by more than `least`, median over the branches.
double run_beyond(double least, const std::vector<std::vector<double>>& steps) {
  std::vector<double> runs;
  for (const auto& branch : steps) {
    double run = 0.0;
    for (const double step : branch) run += step > least ? step : 0.0;
    runs.push_back(run);
  }
  return median(runs);
}

void read_branches(TorqueLevel& level, const std::vector<Branch>& branches) {
  std::vector<std::vector<double>> steps;  // travel within each bin, along the branch
  std::vector<double> flanks;              // the same of the last one: the loaded flank
  std::vector<double> travels;
  for (const Branch& b : branches) {
    if (!within(b.amplitude, 0.999 * level.amplitude)) continue;
    const auto x = signals::branch_positions(*b.trace, *b.cycles, b.crossing, 0.98 * level.amplitude, kBins);
    if (x.empty()) continue;
    steps.emplace_back();
    for (std::size_t k = 0; k < kBins; ++k) steps.back().push_back(x[k + 1] - x[k]);
    flanks.push_back(steps.back().back());
    travels.push_back(travel_of(b));
  }
  if (steps.empty()) return;
  const double least = kFree * std::max(median(flanks), 0.0) + 3.0 * level.resolution;  // within one bin
  level.free_run = run_beyond(least, steps);
  level.sure_run = run_beyond(std::max(least, level.least_way), steps);
  level.travel = median(travels);
  level.visible = std::max(2.0 * least, kFinest * level.resolution);  // a gap may end in the next bin
}

void summarise(TorqueLevel& level) {
  const double n = static_cast<double>(level.plays.size());
  level.play = median(level.plays);
  // The median absolute deviation of few loops is often zero by chance: half their range is not.
  const auto [low, high] = std::minmax_element(level.plays.begin(), level.plays.end());
  const double spread = std::max(robust_std(level.plays), 0.25 * (*high - *low));
  level.std = std::sqrt(spread * spread / n + std::pow(median(level.widths), 2) +
                        2.0 * level.resolution * level.resolution);
}

std::vector<words::Play> plays_of(const std::vector<TorqueLevel>& levels) {
  std::vector<words::Play> plays;
  for (const TorqueLevel& level : levels)
    plays.push_back({level.play, level.amplitude, std::ssize(level.plays)});
  return plays;
}

bool disagree(const TorqueLevel& a, const TorqueLevel& b) {
  return std::abs(a.play - b.play) > 2.0 * std::hypot(a.std, b.std);
}

/// Limit on a gap: it cannot exceed the play at any level, and would have stood out where nothing runs free.
/// A play is never less than none, so one that was read so limits a gap by its error alone.
double limit_of(const std::vector<TorqueLevel>& levels) {
  double limit = kInfinity;
  for (const TorqueLevel& level : levels) {
    const double most = std::max(std::max(level.play, 0.0) + kSurely * level.std, kFinest * level.resolution);
    limit = std::min(limit, level.shows_play() ? most : std::min(most, level.visible));
  }
  return limit;
}

void report_disagreement(const std::vector<TorqueLevel>& levels, GapEstimate& estimate) {
  estimate.verdict = GapVerdict::kInconclusive;
  estimate.reason = words::play_depends_on_level(plays_of(levels));
}

void report_play(const std::vector<TorqueLevel>& levels, GapEstimate& estimate) {
  double sum = 0.0, variance = 0.0;
  for (const TorqueLevel& level : levels) {
    sum += level.play / static_cast<double>(levels.size());
    variance = std::max(variance, level.std * level.std);
  }
  estimate.verdict = GapVerdict::kBacklash;
  estimate.smallest_visible_gap = levels.front().visible;
  estimate.gap = sum;
  estimate.std = std::sqrt(variance);
  estimate.ci95 = {std::max(sum - kSurely * estimate.std, 0.0), sum + kSurely * estimate.std};
  if (levels.size() == 1) estimate.warnings.push_back(words::play_at_one_level());
  estimate.reason = words::play_read(plays_of(levels), levels.front().free_run);
}

/// No play at any level, but hysteresis.
void report_none(const std::vector<TorqueLevel>& levels, GapEstimate& estimate) {
  estimate.verdict = GapVerdict::kNone;
  estimate.reason = words::no_free_run(plays_of(levels));
}

bool any(const std::vector<TorqueLevel>& levels, bool (TorqueLevel::*is)() const) {
  return std::any_of(levels.begin(), levels.end(), [&](const TorqueLevel& level) { return (level.*is)(); });
}

/// Least travel on the branches of a level: where the motor stands still, nothing shows.
double least_travel(const std::vector<TorqueLevel>& levels) {
  double least = kInfinity;
  for (const TorqueLevel& level : levels) least = std::min(least, level.travel);
  return least;
}

/// Why levels without a play do not deny a gap; empty where they do.
Remark doubt(const std::vector<TorqueLevel>& levels, double visible) {
  if (any(levels, &TorqueLevel::leaps)) return words::sticks_and_leaps();
  if (any(levels, &TorqueLevel::runs_free))
    return words::free_run_without_play(plays_of(levels), levels.front().sure_run);
  const double travel = least_travel(levels);
  return visible < travel ? Remark() : words::small_ramps(travel, visible);
}

void decide_gap(const std::vector<TorqueLevel>& levels, GapEstimate& estimate) {
  estimate.smallest_visible_gap = limit_of(levels);
  if (!std::isfinite(estimate.smallest_visible_gap)) estimate.smallest_visible_gap = kNaN;
  for (const TorqueLevel& a : levels)
    for (const TorqueLevel& b : levels)
      if (disagree(a, b)) return report_disagreement(levels, estimate);
  const auto shown =
      std::count_if(levels.begin(), levels.end(), [](const TorqueLevel& l) { return l.shows_play(); });
  if (shown == static_cast<std::ptrdiff_t>(levels.size())) return report_play(levels, estimate);
  estimate.verdict = GapVerdict::kInconclusive;
  if (any(levels, &TorqueLevel::runs_backwards)) {
    estimate.reason = words::loop_runs_backwards(plays_of(levels));
    return;
  }
  if (shown > 0) {
    estimate.reason =
        any(levels, &TorqueLevel::leaps) ? words::sticks_and_leaps() : words::play_at_some_levels();
    return;
  }
  estimate.reason = doubt(levels, estimate.smallest_visible_gap);
  if (estimate.reason.empty()) report_none(levels, estimate);
}

}  // namespace

std::optional<GapEstimate> read_lost_motion(std::span<const MotorTrace> recordings,
                                            std::span<const signals::SignalFacts> facts) {
  std::vector<signals::TorqueCycles> cycles;
  std::vector<Loop> loops;
  std::vector<Branch> branches;
  double resolution = 0.0, least_way = 0.0;
  cycles.reserve(recordings.size());  // branches point into it
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const MotorTrace& trace = recordings[i];
    cycles.push_back(signals::torque_cycles(trace));
    if (cycles.back().following < kFollowing) return std::nullopt;
    if (!facts[i].moves()) return std::nullopt;
    resolution = std::max(resolution, facts[i].noise);
    least_way = std::max(least_way, facts[i].least_way());
    for (Loop& loop : loops_of(trace, cycles.back())) loops.push_back(std::move(loop));
    for (const Branch& branch : branches_of(trace, cycles.back())) branches.push_back(branch);
  }
  GapEstimate estimate;
  estimate.method = GapMethod::kLostMotion;
  estimate.quantity = GapQuantity::kPlayAtZeroTorque;
  for (const Loop& loop : loops) estimate.events.push_back(loop.event);
  std::vector<TorqueLevel> levels = levels_of(loops);
  if (levels.empty()) return std::nullopt;
  for (TorqueLevel& level : levels) {
    level.resolution = resolution;
    level.least_way = least_way;
    read_branches(level, branches);
    summarise(level);
  }
  decide_gap(levels, estimate);
  return estimate;
}

}  // namespace gapscope::internal::sliding_mode
