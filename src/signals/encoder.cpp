#include "signals/encoder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "signals/noise.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kMostlyStill = 0.95;  ///< share of samples without a step that makes steps rare
constexpr double kLeastFloor = 1e-9;   ///< of the travel: what a computed position leaves

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
  return std::max({rounding_noise(trace.quantum), noise_about_motion(trace.x1, trace.stamps),
                   kLeastFloor * (*high - *low), 1e-15});
}

bool exceeds_a_count(double way, double floor) {
  return std::round(std::abs(way) * rounding_noise(1.0) / floor) > 1.0;
}

}  // namespace gapscope::internal::signals
