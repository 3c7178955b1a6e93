#include "signals/period.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::signals {
namespace {

constexpr double kExact = 1e-3;        ///< share of the variance by which one period may differ from the next
constexpr std::size_t kCoarse = 3000;  ///< samples of the search for an exact period

constexpr std::size_t kThinned = 1500;  ///< samples in which a rough period is looked for
constexpr double kAlike = 0.15;         ///< rms difference of two periods of the input, over its size
constexpr double kNearBest = 1.5;       ///< the first lag that is about as good as the best is the period
constexpr std::size_t kPartsOfPeriod = 50;
constexpr double kSteady = 0.05;  ///< rms difference of their means over √2, over the input's size

double variance(std::span<const double> u) {
  const double m = mean(u);
  double sum = 0.0;
  for (const double v : u) sum += (v - m) * (v - m);
  return sum / static_cast<double>(u.size());
}

/// Mean squared change over a lag [samples], over twice the variance.
double change(std::span<const double> u, double lag, std::size_t stride, double var) {
  double sum = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; static_cast<double>(i) + lag < static_cast<double>(u.size() - 1);
       i += stride, ++n) {
    const double d = between_samples(u, static_cast<double>(i) + lag) - u[i];
    sum += d * d;
  }
  return n > 0 ? 0.5 * sum / (static_cast<double>(n) * var) : kInfinity;
}

/// Best lag in [low, high] by a grid that closes in.
double refine(std::span<const double> u, double low, double high, std::size_t stride, double var) {
  double best = 0.5 * (low + high), width = 0.5 * (high - low), least = change(u, best, stride, var);
  for (; width > 1e-4; width *= 0.5) {
    const double centre = best;
    for (const double lag : {centre - 0.5 * width, centre + 0.5 * width})
      if (const double c = change(u, lag, stride, var); c < least) least = c, best = lag;
  }
  return best;
}

/// First lag at which the input repeats itself, within a few samples; 0 if none.
double first_return(std::span<const double> u, double most, double var) {
  const std::size_t stride = std::max<std::size_t>(1, u.size() / kCoarse);
  const double limit = 0.05;
  bool away = false;
  double best = 0.0, least = limit;
  for (double lag = 1.0; lag < most; lag += static_cast<double>(stride)) {
    const double c = change(u, lag, stride, var);
    if (c > 0.3) away = true;
    if (!away) continue;
    if (c < least) least = c, best = lag;
    if (best > 0.0 && c > 0.3) break;  // past the first return
  }
  return best;
}

/// Whether periods differ by no more than noise does, which means over a part of a period hardly have: an
/// amplitude that changes on the way is another input.
bool comes_back(std::span<const double> u, std::size_t period, double size) {
  const std::size_t length = std::max<std::size_t>(1, period / kPartsOfPeriod);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i + period + length <= u.size(); i += length, count += 1.0)
    sum += std::pow(mean(u.subspan(i + period, length)) - mean(u.subspan(i, length)), 2);
  return std::sqrt(0.5 * sum / std::max(count, 1.0)) < kSteady * size;
}

std::vector<double> thinned(std::span<const double> v, std::size_t step) {
  std::vector<double> thin;
  for (std::size_t i = 0; i < v.size(); i += step) thin.push_back(v[i]);
  return thin;
}

}  // namespace

double exact_period(const MotorTrace& trace, double fewest) {
  const std::span<const double> u = trace.u;
  if (u.size() < 200) return 0.0;
  const double var = variance(u);
  if (!(var > 0.0)) return 0.0;
  const double n = static_cast<double>(u.size());
  const double rough = first_return(u, n / fewest, var);
  if (rough <= 0.0) return 0.0;
  const double stride = std::max(1.0, n / static_cast<double>(kCoarse));
  const double near = refine(u, rough - 1.5 * stride, rough + 1.5 * stride, 1, var);
  const double repeats =
      std::floor((n - 2.0) / near) - 1.0;  // many periods apart: the same error counts less
  if (repeats < 1.0) return 0.0;  // one repetition ends where the recording does: nothing to compare with
  const double lag = refine(u, repeats * near - 2.0, repeats * near + 2.0, 1, var);
  if (change(u, lag / repeats, 1, var) > kExact) return 0.0;
  return lag / repeats * trace.dt;
}

std::size_t rough_period(const MotorTrace& trace) {
  if (!trace.even()) return 0;
  const std::size_t step = std::max<std::size_t>(1, trace.size() / kThinned);
  const std::vector<double> u = thinned(trace.u, step);
  const double size = std::sqrt(variance(u));
  if (!(size > 0.0)) return 0;
  const std::size_t last = u.size() / 2 + u.size() / 50;
  std::vector<double> differences(last, kInfinity);
  bool left = false;  // the neighbourhood of lag zero
  for (std::size_t lag = 2; lag < last; ++lag) {
    const double d = repetition_error(u, 0, static_cast<double>(lag)) / size;
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
    if (const double d = repetition_error(trace.u, 0, static_cast<double>(lag)); d < least)
      least = d, period = lag;
  return comes_back(trace.u, period, size) ? period : 0;
}

double input_period(const MotorTrace& trace) {
  const double exact = trace.even() ? exact_period(trace, 2.0) / trace.dt : 0.0;
  return exact > 0.0 ? exact : static_cast<double>(rough_period(trace));
}

double repetition_error(std::span<const double> v, std::size_t from, double lag) {
  const auto whole = static_cast<std::size_t>(std::ceil(lag));
  double sum = 0.0;
  for (std::size_t i = from; i + whole < v.size(); ++i)
    sum += std::pow(between_samples(v, static_cast<double>(i) + lag) - v[i], 2);
  return std::sqrt(0.5 * sum / static_cast<double>(v.size() - whole - from));
}

}  // namespace gapscope::internal::signals
