#include "signals/encoder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "signals/noise.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kMostlyStill = 0.95;  ///< share of samples without a step that makes steps rare
constexpr double kLeastFloor = 1e-9;   ///< of the travel: what a computed position leaves
constexpr double kFastStep = 3.0;      ///< quanta per sample at which no sample should stand still
constexpr std::size_t kReach = 8;      ///< samples on either side over which the motion is fast
constexpr std::size_t kFewestFast = 100;

}  // namespace

double rounding_noise(double quantum) { return quantum / std::sqrt(12.0); }

double encoder_quantum(const MotorTrace& trace) {
  return trace.quantum > 0.0 ? trace.quantum : seen_quantum(trace.x1);
}

double quantum_or_least_step(std::span<const double> x1) {
  if (const double q = seen_quantum(x1); q > 0.0) return q;
  std::vector<double> steps;
  for (std::size_t i = 1; i < x1.size(); ++i)
    if (x1[i] != x1[i - 1]) steps.push_back(std::abs(x1[i] - x1[i - 1]));
  const double still = 1.0 - static_cast<double>(steps.size()) / static_cast<double>(x1.size());
  return steps.empty() || still < kMostlyStill ? 0.0 : *std::min_element(steps.begin(), steps.end());
}

double encoder_floor(const MotorTrace& trace) {
  const auto [low, high] = std::minmax_element(trace.x1.begin(), trace.x1.end());
  return std::max({rounding_noise(trace.quantum), noise_from_spread(trace.x1, trace.stamps),
                   kLeastFloor * (*high - *low), 1e-15});
}

bool exceeds_a_count(double way, double floor) {
  return std::round(std::abs(way) * rounding_noise(1.0) / floor) > 1.0;
}

HeldSamples held_samples(const MotorTrace& trace) {
  const std::span<const double> x = trace.x1;
  const double least = kFastStep * trace.quantum;
  std::size_t fast = 0, still = 0;
  for (std::size_t i = kReach; i + kReach < x.size(); ++i) {
    if (std::abs(x[i + kReach] - x[i - kReach]) < 2.0 * kReach * least) continue;
    ++fast;
    still += x[i] == x[i - 1];
  }
  if (fast < kFewestFast) return {};
  const double share = static_cast<double>(still) / static_cast<double>(fast);
  return {share, 1.0 / (1.0 - std::min(share, 0.999))};
}

}  // namespace gapscope::internal::signals
