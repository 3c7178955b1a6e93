#include "sliding_mode/visible_gap.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "sliding_mode/hidden_gap.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kRestitution = 0.4;  ///< the least that is expected of a contact
constexpr double kShare =             ///< v/Δv
    (1.0 + kSmallestMassRatio) / ((1.0 + kRestitution) * kSmallestMassRatio);

/// The sample farthest from the chord between two crossings of the centre.
std::size_t turn_between(std::span<const double> y, std::size_t first, std::size_t last) {
  const double slope = (y[last] - y[first]) / static_cast<double>(last - first);
  std::size_t turn = first;
  double farthest = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const double away = std::abs(y[i] - y[first] - slope * static_cast<double>(i - first));
    if (away > farthest) farthest = away, turn = i;
  }
  return turn;
}

/// Median speed at which the motor is `distance` away from its last reversal.
double speed_away_from_reversals(const MotorTrace& trace, const signals::SignalFacts& facts,
                                 double distance) {
  const auto& y = trace.x1;
  const auto m = std::max<std::size_t>(1, static_cast<std::size_t>(0.01 * facts.half_period / trace.dt));
  std::vector<double> speeds;
  for (std::size_t k = 1; k < facts.crossings.size(); ++k) {
    const std::size_t turn = turn_between(y, facts.crossings[k - 1], facts.crossings[k]);
    std::size_t i = turn;
    while (i + m + 1 < y.size() && std::abs(y[i] - y[turn]) < distance) ++i;
    if (i >= m && i + m < y.size())
      speeds.push_back(std::abs(y[i + m] - y[i - m]) / (2.0 * trace.dt * static_cast<double>(m)));
  }
  return speeds.empty() ? 0.0 : median(std::move(speeds));
}

}  // namespace

double smallest_visible_gap(const MotorTrace& trace, const signals::SignalFacts& facts, const BankRun& run,
                            std::size_t hiding) {
  const std::size_t sliding = smallest_sliding(run);
  const std::size_t j = std::max(sliding, hiding);
  const double k2 = SuperTwistingGains::from_bound(run.bounds[j]).k2;
  const double slowest =
      kShare * std::sqrt(2.0 * run.floor[j] * k2 / kStepPeak);  // v of the least visible impact
  double gap = std::max(slowest * slowest / run.bounds[sliding], facts.least_way());
  while (gap < 2.0 * facts.amplitude && speed_away_from_reversals(trace, facts, gap) < slowest) gap *= 1.1;
  return gap < 2.0 * facts.amplitude ? gap : kInfinity;
}

double encoder_visible_gap(const signals::SignalFacts& facts) {
  const double floor = std::max(1.5 * facts.noise, facts.quantum);
  const double k2_over_bound = SuperTwistingGains::from_bound(1.0).k2;
  return std::max(kShare * kShare * 2.0 * floor * k2_over_bound / kStepPeak, facts.least_way());
}

double one_body_visible_gap(const MotorTrace& trace, const signals::SignalFacts& facts) {
  const OneBodyFit fit = fit_one_body(trace, facts);
  const double fastest = std::sqrt(2.0) * facts.speed_rms * kPi / facts.half_period;  // [rad/s²]
  const double turns_load = kLightestLoad / (1.0 + kLightestLoad) * fastest;
  if (std::abs(fit.law.constant) > turns_load) return kInfinity;
  const double gap = std::max(fit.hidden, facts.least_way());
  return gap < facts.travel ? gap : kInfinity;
}

}  // namespace gapscope::internal::sliding_mode
