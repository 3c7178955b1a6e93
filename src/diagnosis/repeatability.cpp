#include "diagnosis/repeatability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gapscope::internal::diagnosis {
namespace {

constexpr std::size_t kThinned = 1500;  ///< samples in which a period is looked for
constexpr double kAlike = 0.15;         ///< rms difference of two periods of the input, over its size
constexpr double kNearBest = 1.5;       ///< the first lag that is about as good as the best is the period
constexpr double kDrift = 1.6;          ///< growth of the difference from one period to two that is a drift

/// rms of v(t + lag) − v(t), over √2.
double difference(std::span<const double> v, std::size_t from, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = from; i + lag < v.size(); ++i) sum += std::pow(v[i + lag] - v[i], 2);
  return std::sqrt(0.5 * sum / static_cast<double>(v.size() - lag - from));
}

std::vector<double> thinned(std::span<const double> v, std::size_t step) {
  std::vector<double> thin;
  for (std::size_t i = 0; i < v.size(); i += step) thin.push_back(v[i]);
  return thin;
}

double spread(std::span<const double> v) {
  const double middle = mean(v);
  double sum = 0.0;
  for (const double x : v) sum += (x - middle) * (x - middle);
  return std::sqrt(sum / static_cast<double>(v.size()));
}

struct Pooled {
  double sum = 0.0, count = 0.0;
  void add(double size, double samples) { sum += size * size * samples, count += samples; }
  double value() const { return count > 0.0 ? std::sqrt(sum / count) : kNaN; }
};

}  // namespace

std::size_t repeated_after(const MotorTrace& trace) {
  const std::size_t step = std::max<std::size_t>(1, trace.size() / kThinned);
  const std::vector<double> u = thinned(trace.u, step);
  const double size = spread(u);
  if (!(size > 0.0)) return 0;
  const std::size_t last = u.size() / 2 + u.size() / 50;
  std::vector<double> differences(last, kInfinity);
  bool left = false;  // the neighbourhood of lag zero
  for (std::size_t lag = 2; lag < last; ++lag) {
    const double d = difference(u, 0, lag) / size;
    left = left || d > 2.0 * kAlike;
    if (left) differences[lag] = d;
  }
  const double best = *std::min_element(differences.begin(), differences.end());
  if (!(best < kAlike)) return 0;
  std::size_t coarse = 0;
  while (differences[coarse] > kNearBest * best) ++coarse;
  std::size_t period = coarse * step;
  double least = kInfinity;
  for (std::size_t lag = (coarse - 1) * step; lag <= (coarse + 1) * step; ++lag)
    if (const double d = difference(trace.u, 0, lag); d < least) least = d, period = lag;
  return period;
}

Repeatability repeatability_of(const std::vector<Playback>& playbacks, const HeldOut& held_out) {
  Pooled innovation, free, twice, once;
  std::string read_from;
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const std::size_t period = held_out.periods[r], size = held_out.traces[r].size();
    const std::size_t from = std::max(held_out.scored_from[r], held_out.restart(r));
    if (period == 0 || from + period + period / 2 > size) continue;
    const double samples = static_cast<double>(size - from - period), length = static_cast<double>(period);
    read_from += fmt::format("{}{:.1f} periods of {:.3g} s in {}", read_from.empty() ? "" : ", ",
                             static_cast<double>(size - from) / length, length * held_out.traces[r].dt,
                             held_out.traces[r].file);
    innovation.add(difference(playbacks[r].innovation, from, period), samples);
    free.add(difference(playbacks[r].free, from, period), samples);
    if (from + 2 * period + period / 2 > size) continue;
    once.add(difference(playbacks[r].innovation, from, period), samples);
    twice.add(difference(playbacks[r].innovation, from, 2 * period), samples);
  }
  Repeatability found{innovation.value(), free.value(), true, std::move(read_from)};
  if (twice.count > 0.0) found.stationary = twice.value() < kDrift * once.value();
  return found;
}

}  // namespace gapscope::internal::diagnosis
