#include "sliding_mode/verdict/lost_motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "gapscope/base/statistics.h"
#include "sliding_mode/verdict/loop_positions.h"
#include "sliding_mode/verdict/loop_verdict.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kFollowing = 0.75;      ///< least share of the travel that goes with the change of u
constexpr double kQuasiStatic = 0.9;     ///< the same of a motion in which nothing coasts, for a verdict
constexpr std::size_t kFewestRamps = 3;  ///< of a loop, to either side together

/// A recording that is a loop.
struct Loop {
  MotorTrace trace;
  signals::TorqueCycles cycles;
  std::vector<ZeroPassage> passages;
};

Remark why_no_loop(const MotorTrace& trace, const signals::SignalFacts& facts,
                   const signals::TorqueCycles& cycles) {
  if (!facts.moves()) return words::stands_still();
  if (cycles.crossings.size() + 1 < kFewestRamps)
    return words::few_torque_ramps(static_cast<long>(cycles.crossings.size()));
  if (trace.u.size() == trace.x1.size() && cycles.following >= kFollowing) return {};
  return words::does_not_follow(100.0 * cycles.following);
}

/// Two successive zeros of the input, and how far x1 came in between.
void add_events(const Loop& loop, GapEvidence& evidence) {
  for (std::size_t i = 1; i < loop.passages.size(); ++i) {
    const ZeroPassage &a = loop.passages[i - 1], &b = loop.passages[i];
    const double smaller = std::min(a.amplitude, b.amplitude), larger = std::max(a.amplitude, b.amplitude);
    if (a.rising == b.rising || larger > kSameLevel * smaller) continue;
    GapEvent e;
    e.file = loop.trace.file;
    e.t1 = a.time, e.t2 = b.time;
    e.x1_t1 = a.x1, e.x1_t2 = b.x1;
    e.direction = a.rising ? 1 : -1;  // the ramp between them goes this way
    e.gap = e.direction * (b.x1 - a.x1);
    evidence.events.push_back(std::move(e));
  }
}

/// Amplitudes by level, the smallest first.
std::vector<double> amplitudes_of(const std::vector<Loop>& loops) {
  std::vector<double> all, levels;
  for (const Loop& loop : loops)
    for (const ZeroPassage& p : loop.passages) all.push_back(p.amplitude);
  std::ranges::sort(all);
  for (const double a : all)
    if (levels.empty() || !within_level(a, levels.back())) levels.push_back(a);
  return levels;
}

/// One level of one recording; nothing where it has too few ramps or one direction only.
std::optional<LoopReading> reading_of(const Loop& loop, double amplitude) {
  std::vector<const ZeroPassage*> ramps;
  std::ptrdiff_t rising = 0;
  for (const ZeroPassage& p : loop.passages)
    if (within_level(p.amplitude, amplitude)) ramps.push_back(&p), rising += p.rising;
  if (ramps.size() < kFewestRamps || rising == 0 || rising == std::ssize(ramps)) return std::nullopt;
  return read_loop(ramps, loop.trace.quantum);
}

/// Recordings of one level, weighted by their ramps; what they differ by counts as error as well.
std::optional<LoopReading> combined(const std::vector<LoopReading>& readings) {
  if (readings.empty()) return std::nullopt;
  LoopReading all;
  for (const LoopReading& r : readings) all.ramps += r.ramps;
  double between = 0.0;
  for (const LoopReading& r : readings) all.lost_motion += r.lost_motion * r.ramps / all.ramps;
  for (const LoopReading& r : readings) {
    const double weight = static_cast<double>(r.ramps) / all.ramps;
    all.half_width = std::hypot(all.half_width, weight * r.half_width);
    between = std::hypot(between, weight * (r.lost_motion - all.lost_motion));
  }
  all.half_width = std::max(all.half_width, kSurely * between);
  return all;
}

std::vector<TorqueLevel> levels_of(const std::vector<Loop>& loops, double resolution, double least_way) {
  std::vector<LoopBranch> branches;
  for (const Loop& loop : loops)
    for (std::size_t i = 0; i < loop.cycles.crossings.size(); ++i)
      branches.push_back({&loop.trace, &loop.cycles, i});
  std::vector<TorqueLevel> levels;
  for (const double amplitude : amplitudes_of(loops)) {
    std::vector<LoopReading> readings;
    for (const Loop& loop : loops)
      if (const auto r = reading_of(loop, amplitude)) readings.push_back(*r);
    const auto reading = combined(readings);
    if (!reading) continue;
    levels.push_back({amplitude, resolution, *reading, {}});
    levels.back().shape = read_shape(branches, amplitude, resolution, least_way);
  }
  return levels;
}

/// x1 lies at zero torque where it turns: what P leaves of the travel may be its error, noise and counting. A
/// drive that coasts and then stands does so; one in which nothing coasts is so stiff.
bool has_no_flank(const TorqueLevel& level, double least_way) {
  return level.shape.travel - level.play() <= level.reading.half_width + least_way;
}

}  // namespace

LoopSearch read_lost_motion(std::span<const MotorTrace> recordings,
                            std::span<const signals::SignalFacts> facts) {
  LoopSearch search;
  std::vector<Loop> loops;
  double resolution = 0.0, least_way = 0.0;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    signals::TorqueCycles cycles = signals::torque_cycles(recordings[i]);
    const Remark against = why_no_loop(recordings[i], facts[i], cycles);
    if (!against.empty() && search.why_not.empty()) search.why_not = against;
    if (!against.empty()) continue;
    auto passages = zero_passages(recordings[i], cycles);
    loops.push_back({recordings[i], std::move(cycles), std::move(passages)});
    resolution = std::max(resolution, facts[i].noise);
    least_way = std::max(least_way, facts[i].least_way());
  }
  search.decides = !loops.empty() && loops.size() == recordings.size() &&
                   std::all_of(loops.begin(), loops.end(),
                               [](const Loop& l) { return l.cycles.following >= kQuasiStatic; });
  const std::vector<TorqueLevel> levels = levels_of(loops, resolution, least_way);
  if (levels.empty()) {
    if (search.why_not.empty()) search.why_not = words::few_torque_ramps(0);
    return search;
  }
  const auto flankless = [&](const TorqueLevel& level) { return has_no_flank(level, least_way); };
  if (!search.decides && std::ranges::any_of(levels, flankless)) {
    if (search.why_not.empty()) search.why_not = words::no_flank();
    return search;
  }
  search.found = loop_evidence(levels);
  for (const Loop& loop : loops) add_events(loop, search.found->evidence);
  return search;
}

void speak_of_locked_output(const LoopSearch& loops, GapEstimate& estimate) {
  if (estimate.verdict != GapVerdict::kInconclusive) return;
  const Remark why = loops.why_not.empty() ? words::loop_not_asked_for() : loops.why_not;
  const bool by_bound = estimate.method == GapMethod::kPaper && loops.found;
  estimate.reason = by_bound ? words::locked_with_bound() : words::locked_without_loop(why);
}

}  // namespace gapscope::internal::sliding_mode
