#include "independent_plant/excitation.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/require.h"
#include "gapscope/base/statistics.h"

namespace gapscope::independent_plant {
namespace {

/// A wave of period 1 and amplitude 1, odd about the half period.
double odd_wave(double phase, double (*half)(double, const BlindExcitation&), const BlindExcitation& e) {
  const double p = phase - std::floor(phase);
  return p < 0.5 ? half(2.0 * p, e) : -half(2.0 * p - 1.0, e);
}

double triangle_half(double p, const BlindExcitation&) { return p < 0.5 ? 2.0 * p : 2.0 - 2.0 * p; }

/// Dwell split to both ends, so that the zero crossing lies in its middle.
double trapezoid_half(double p, const BlindExcitation& e) {
  const double from_middle = std::abs(p - 0.5), ramp = 0.5 * (1.0 - e.dwell - e.hold);
  return std::clamp((0.5 * e.hold + ramp - from_middle) / ramp, 0.0, 1.0);
}

std::vector<double> multisine(const BlindExcitation& e, std::size_t n, double rate, std::uint64_t seed) {
  std::mt19937_64 phases = random_stream(seed, "blind multisine");
  std::vector<double> u(n, 0.0);
  for (int line = 0; line < e.lines; ++line) {
    const double share = e.lines > 1 ? static_cast<double>(line) / (e.lines - 1) : 0.0;
    const double f = e.frequency + share * (e.frequency_end - e.frequency);
    const double phase = uniform(phases, 0.0, 2.0 * kPi);
    for (std::size_t k = 0; k < n; ++k)
      u[k] += std::sin(2.0 * kPi * f * static_cast<double>(k) / rate + phase);
  }
  double peak = 1e-300;
  for (const double value : u) peak = std::max(peak, std::abs(value));
  for (double& value : u) value *= e.amplitude / peak;
  return u;
}

std::vector<double> steps(const BlindExcitation& e, std::size_t n, double rate, std::uint64_t seed) {
  std::mt19937_64 levels = random_stream(seed, "blind steps");
  std::vector<double> u;
  while (u.size() < n) {
    const double level = uniform(levels, -e.amplitude, e.amplitude);
    const double length = rate / e.frequency * uniform(levels, 0.5, 1.5);
    u.insert(u.end(), std::max<std::size_t>(1, static_cast<std::size_t>(length)), level);
  }
  u.resize(n);
  return u;
}

double wave(const BlindExcitation& e, double t, double duration) {
  switch (e.waveform) {
    case Waveform::kSine:
      return std::sin(2.0 * kPi * e.frequency * t);
    case Waveform::kSweptSine:
      return std::sin(2.0 * kPi * t * (e.frequency + 0.5 * (e.frequency_end - e.frequency) * t / duration));
    case Waveform::kTriangle:
      return odd_wave(e.frequency * t, triangle_half, e);
    case Waveform::kTrapezoid:
      return odd_wave(e.frequency * t, trapezoid_half, e);
    case Waveform::kMultisine:
    case Waveform::kSteps:
      break;
  }
  return 0.0;
}

}  // namespace

std::vector<double> command(const BlindExcitation& e, double rate, double duration, std::uint64_t seed) {
  GAPSCOPE_REQUIRE(rate > 0.0 && duration > 0.0 && e.frequency > 0.0 && e.dwell + e.hold < 1.0);
  const std::size_t n = static_cast<std::size_t>(std::llround(duration * rate));
  std::vector<double> u(n);
  if (e.waveform == Waveform::kMultisine)
    u = multisine(e, n, rate, seed);
  else if (e.waveform == Waveform::kSteps)
    u = steps(e, n, rate, seed);
  else
    for (std::size_t k = 0; k < n; ++k) u[k] = e.amplitude * wave(e, static_cast<double>(k) / rate, duration);
  for (double& value : u) value += e.offset;
  return u;
}

}  // namespace gapscope::independent_plant
