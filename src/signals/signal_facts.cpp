#include "signals/signal_facts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/encoder.h"
#include "signals/noise.h"
#include "signals/period.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kDithers = 0.4;   ///< noise in quanta, from which on samples are independent
constexpr double kFastest = 1e60;  ///< beyond it squares of accelerations leave the range of a double [rad/s]

using Samples = std::span<const double>;

/// Root mean square of the speed, by differences wide enough that noise does not count.
double rms_speed(Samples y, double dt, double noise, double amplitude) {
  for (std::size_t m = 1; m < y.size() / 8; m *= 2) {
    double sum = 0.0;
    for (std::size_t i = m; i < y.size(); ++i) sum += (y[i] - y[i - m]) * (y[i] - y[i - m]);
    const double step = std::sqrt(sum / static_cast<double>(y.size() - m));
    if (step > 10.0 * noise || step > 0.3 * amplitude) return step / (dt * static_cast<double>(m));
  }
  return 0.0;
}

/// Instants at which y passes the centre, 30 % of the amplitude of hysteresis.
std::vector<std::size_t> crossings(Samples y, double centre, double amplitude) {
  std::vector<std::size_t> found;
  int side = 0;
  std::size_t last = 0;  // where the centre itself was passed
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double d = y[i] - centre;
    if (i > 0 && (d > 0.0) != (y[i - 1] - centre > 0.0)) last = i;
    const int now = d > 0.3 * amplitude ? 1 : d < -0.3 * amplitude ? -1 : side;
    if (side != 0 && now != side) found.push_back(last);
    side = now;
  }
  return found;
}

/// x1 less what it gains from one period of the input to the next: an unsymmetrical input makes a free motor
/// wander, and only what it does about that is periodic.
std::vector<double> without_drift(const MotorTrace& trace, double period) {
  std::vector<double> level(trace.x1.begin(), trace.x1.end());
  const auto lag = static_cast<std::size_t>(std::lround(period / trace.dt));
  if (lag == 0) return level;
  std::vector<double> gains;
  gains.reserve(level.size() - std::min(lag, level.size()));
  for (std::size_t i = lag; i < level.size(); ++i) gains.push_back(trace.x1[i] - trace.x1[i - lag]);
  const double per_sample = median(std::move(gains)) / static_cast<double>(lag);
  for (std::size_t i = 0; i < level.size(); ++i) level[i] -= per_sample * static_cast<double>(i);
  return level;
}

/// x1 less its mean over one period of the input, which follows a drift of any course: a free motor may first
/// settle far from where it began, so that it never passes the centre of the whole recording again.
std::vector<double> about_its_mean(Samples y, std::size_t lag) {
  std::vector<double> sums{0.0}, level(y.begin(), y.end());
  for (const double x : y) sums.push_back(sums.back() + x);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t from = std::min(i - std::min(i, lag / 2), y.size() - lag);
    level[i] -= (sums[from + lag] - sums[from]) / static_cast<double>(lag);
  }
  return level;
}

/// The period of an input that comes again, though not from sample to sample; 0: it does not.
double even_period(const MotorTrace& trace) {
  constexpr double kEven =
      1.1;  ///< longest over shortest half period: 1.05 loses noisy turns, 1.2 takes in chance
  if (trace.u.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(trace.u.begin(), trace.u.end());
  const std::vector<std::size_t> found = crossings(trace.u, 0.5 * (*low + *high), 0.5 * (*high - *low));
  if (found.size() <= kFewestHalfPeriods) return 0.0;
  std::vector<double> lengths;
  for (std::size_t i = 1; i < found.size(); ++i)
    lengths.push_back(trace.dt * static_cast<double>(found[i] - found[i - 1]));
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  return *longest < kEven * *shortest ? 2.0 * median(lengths) : 0.0;
}

double leaning(Samples u) {
  double sum = 0.0, squares = 0.0;
  for (const double v : u) sum += v;
  const double level = sum / static_cast<double>(u.size());
  for (const double v : u) squares += (v - level) * (v - level);
  return squares > 0.0 ? std::abs(level) / std::sqrt(2.0 * squares / static_cast<double>(u.size())) : 0.0;
}

/// Travel, centre and half periods of what is left of x1 without its drift.
void read_period(const MotorTrace& trace, Samples level, SignalFacts& facts) {
  const std::vector<double> values(level.begin(), level.end());
  const double low = quantile(values, 0.02), high = quantile(values, 0.98);
  const auto [least, most] = std::minmax_element(level.begin(), level.end());
  facts.travel = *most - *least;
  facts.centre = 0.5 * (low + high);
  facts.amplitude = 0.5 * (high - low);
  facts.crossings = crossings(level, facts.centre, facts.amplitude);
  const auto& found = facts.crossings;
  std::vector<double> lengths;
  for (std::size_t i = 1; i < found.size(); ++i)
    lengths.push_back(trace.dt * static_cast<double>(found[i] - found[i - 1]));
  facts.half_periods = lengths.size();
  facts.half_period = median(std::move(lengths));
}

}  // namespace

/// On the six drives of 871001 150 gap sine and 3391001 60 gap trapezoid where it matters to an impact,
/// errors are 1.1 standard deviations in the mean square; without it 1.5.
double SignalFacts::sharing(double step) const {
  if (noise > kDithers * quantum) return 1.0;
  return std::max(1.0, quantum / std::max(step, 1e-300));
}

SignalFacts read_facts(const MotorTrace& trace) {
  SignalFacts facts;
  facts.leaning = leaning(trace.u);
  const Samples y = trace.x1;
  if (y.size() < 200 || !(trace.dt > 0.0)) {
    facts.defect = {"too_short", "recording too short: record at least three periods of a periodic motion"};
    return facts;
  }
  facts.quantum = encoder_quantum(trace);
  facts.noise = std::max(noise_from_differences(y), rounding_noise(facts.quantum));
  facts.input_period = exact_period(trace, kFewestRepetitions);
  read_period(trace, without_drift(trace, facts.input_period), facts);
  const double coming_again = facts.input_period > 0.0 ? facts.input_period : even_period(trace);
  const auto period = static_cast<std::size_t>(std::lround(coming_again / trace.dt));
  if (facts.half_periods < kFewestHalfPeriods && period > 0 && facts.moves())
    read_period(trace, about_its_mean(y, period), facts);
  if (!facts.moves()) {
    facts.defect = {"no_motion", "no motion above the encoder's noise: raise the excitation"};
    return facts;
  }
  facts.speed_rms = rms_speed(y, trace.dt, facts.noise, facts.amplitude);
  if (facts.half_periods < kFewestHalfPeriods)
    facts.defect = {
        "no_period",
        "no periodic motion: {} half periods found, {} needed; excite with a sine and record three periods or more",
        {static_cast<long>(facts.half_periods), static_cast<long>(kFewestHalfPeriods)}};
  else if (!(facts.speed_rms < kFastest))
    facts.defect = {"jumps", "x1 jumps farther than any motion does: look for a spike, and for the unit"};
  else if (!(facts.speed_rms > 0.0))
    facts.defect = {"no_speed", "no speed above the encoder's noise: raise the excitation"};
  return facts;
}

}  // namespace gapscope::internal::signals
