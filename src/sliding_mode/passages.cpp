#include "sliding_mode/passages.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kContrast = 1.6;  ///< ρ

constexpr double kEcho = 2.5;  ///< an earlier impact that is this much weaker is none; a later one is an echo
constexpr double kEchoReach = 0.2;      ///< of a half period
constexpr double kRebound = 0.25;       ///< of the flight, from the impact before to its begin
constexpr double kSameSignSteps = 3.5;  ///< of the grid: four and more
constexpr std::size_t kPersistent = 3;  ///< bounds that show what happened to the motor
/// Recoil, ringing and overshoot follow an impact with the opposite sign, sometimes more abruptly than it;
/// what precedes an impact with the opposite sign (the motor speeding up in the gap) is far less abrupt.
bool dominates(const BankEvent& strong, const BankEvent& weak, const BankRun& run) {
  const double ratio = strong.abruptness / weak.abruptness;
  if (strong.sign == weak.sign) return ratio > std::pow(run.bounds[1] / run.bounds[0], kSameSignSteps);
  return strong.start <= weak.start ? ratio >= 1.0 / kEcho : ratio > kEcho;
}

/// Abruptness of the second half of [from, to): what the motion before the impact needs [rad/s²].
double bound_needed_before(const BankMarks& run, std::size_t from, std::size_t to) {
  const std::size_t middle = (from + to) / 2;
  for (std::size_t j = run.bounds.size(); j-- > 0;)
    for (std::size_t i = middle; i < to; ++i)
      if (run.is_loud(i, j)) return abruptness(run, j, run.highest_peak(middle, to));
  return 0.0;
}

/// Contact that was lost soon after an impact was lost in the rebound from it, with different speeds of motor
/// and load. (A mark of the release itself is far less abrupt than the impact that follows it.)
bool thrown_off(const TransitionContext& context, const BankEvent& before, const BankEvent& impact,
                const Transition& t) {
  const double since = t.event.t1 - context.trace.time(before.start);
  return since >= 0.0 && since < kRebound * (t.event.t2 - t.event.t1) &&
         kEcho * before.abruptness > impact.abruptness;
}

}  // namespace

std::vector<BankEvent> all_events(const BankMarks& run, double half_period) {
  return link_events(run, run.excursions, static_cast<std::size_t>(std::max(4.0, 0.01 * half_period)));
}

std::optional<double> least_top(std::span<const BankEvent> events, const BankRun& run,
                                std::size_t half_periods) {
  std::vector<double> tops;
  for (const BankEvent& e : events)
    if (e.seen >= kPersistent) tops.push_back(run.bounds[e.top]);
  if (tops.size() < signals::kFewestHalfPeriods) return {};
  std::sort(tops.rbegin(), tops.rend());
  return tops[std::min(half_periods, tops.size()) - 1] / 6.0;
}

std::vector<BankEvent> main_events(std::span<const BankEvent> events, const BankRun& run, double least,
                                   double half_period) {
  const auto reach = static_cast<std::size_t>(kEchoReach * half_period);
  std::vector<BankEvent> found;
  for (const BankEvent& e : events) {
    if (e.seen < kPersistent || run.bounds[e.top] < least) continue;
    const bool echo = std::any_of(events.begin(), events.end(), [&](const BankEvent& other) {
      const std::size_t distance = other.start > e.start ? other.start - e.start : e.start - other.start;
      return other.seen >= kPersistent && distance <= reach && dominates(other, e, run);
    });
    if (!echo) found.push_back(e);
  }
  return found;
}

std::size_t top_bound(std::span<const std::size_t> tops, double share, std::size_t none) {
  const std::size_t count = std::accumulate(tops.begin(), tops.end(), std::size_t{0});
  if (count == 0) return none;
  const auto ranked = [&](std::size_t rank) {  // of the sorted tops
    std::size_t j = 0;
    for (std::size_t below = tops[0]; below <= rank; below += tops[j]) ++j;
    return static_cast<double>(j);
  };
  const double place = share * static_cast<double>(count - 1);
  const auto below = static_cast<std::size_t>(place);
  const double low = ranked(below), high = ranked(std::min(below + 1, count - 1));
  return static_cast<std::size_t>(low + (place - static_cast<double>(below)) * (high - low));
}

Transition read_passage(const TransitionContext& context, const BankEvent& before, const BankEvent& impact,
                        double sliding) {
  const BankMarks& run = context.run;
  const std::size_t from = before.start, to = impact.start;
  Transition t = read_transition(context, impact, from);
  const double needed = std::max(
      sliding,
      bound_needed_before(run, from, to - std::min(to - from, std::max<std::size_t>(2, impact.latency))));
  t.contrast = impact.abruptness / needed;
  if (t.contrast < kContrast)
    t.refusal = Refusal::kContrast;
  else if (t.refusal == Refusal::kNone && thrown_off(context, before, impact, t))
    t.refusal = Refusal::kThrownOff;
  return t;
}

}  // namespace gapscope::internal::sliding_mode
