#include "sliding_mode/marks/main_events.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kEchoReach = 0.2;      ///< of a half period
constexpr double kSameSignSteps = 3.5;  ///< of the grid: four and more
constexpr std::size_t kPersistent = 3;  ///< bounds that show what happened to the motor
/// Recoil, ringing and overshoot follow an impact with the opposite sign, sometimes more abruptly than it;
/// what precedes an impact with the opposite sign (the motor speeding up in the gap) is far less abrupt.
bool dominates(const BankEvent& strong, const BankEvent& weak, const BankRun& run) {
  const double ratio = strong.abruptness / weak.abruptness;
  if (strong.sign == weak.sign) return ratio > std::pow(run.bounds[1] / run.bounds[0], kSameSignSteps);
  return strong.start <= weak.start ? ratio >= 1.0 / kEcho : ratio > kEcho;
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

}  // namespace gapscope::internal::sliding_mode
