#include "report/signals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/require.h"
#include "report/figure_data.h"

namespace gapscope::internal::report {

std::vector<double> difference_of(std::span<const double> a, std::span<const double> b) {
  std::vector<double> result(std::min(a.size(), b.size()));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

std::vector<double> times(std::span<const double> a, double factor) {
  std::vector<double> result(a.begin(), a.end());
  for (double& v : result) v *= factor;
  return result;
}

std::vector<double> moving_mean(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> sums = {0.0}, result;
  sums.reserve(values.size() + 1), result.reserve(values.size());
  for (const double v : values) sums.push_back(sums.back() + v);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t r = std::min({reach, i, values.size() - 1 - i});
    result.push_back((sums[i + r + 1] - sums[i - r]) / static_cast<double>(2 * r + 1));
  }
  return result;
}

bool Stretches::are_a_block() const {
  constexpr double kShownOfPixel = 4.0;  // samples of a pixel column that decimate_columns() keeps
  const auto samples = static_cast<double>(each * means.size());
  const double between = rms(means) * rms(means) - mean(means) * mean(means);
  return samples > kShownOfPixel * kColumnPixels && rms(spreads) * rms(spreads) > between;
}

Stretches stretches_of(std::span<const double> values) {
  constexpr std::size_t kStretches = 200;
  Stretches s;
  s.each = (values.size() + kStretches - 1) / kStretches;
  for (std::size_t i = 0; s.each > 0 && i + s.each <= values.size(); i += s.each) {
    const std::span<const double> part = values.subspan(i, s.each);
    const double m = mean(part);
    s.means.push_back(m);
    s.spreads.push_back(std::sqrt(std::max(0.0, rms(part) * rms(part) - m * m)));
  }
  return s;
}

double robust_middle(const std::vector<double>& values) {
  return (quantile(values, 0.01) + quantile(values, 0.99)) / 2;
}

double peak_to_peak(std::span<const double> values) {
  double low = kNaN, high = kNaN;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    low = std::isnan(low) ? v : std::min(low, v);
    high = std::isnan(high) ? v : std::max(high, v);
  }
  return high - low;
}

double largest_magnitude(std::span<const double> values) {
  double largest = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  return largest;
}

std::vector<std::size_t> middle_crossings(std::span<const double> values) {
  std::vector<std::size_t> crossings;
  if (values.empty()) return crossings;
  const std::vector<double> copy(values.begin(), values.end());
  const double low = quantile(copy, 0.02), high = quantile(copy, 0.98);
  const double middle = (low + high) / 2, arm = 0.15 * (high - low);
  int side = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int now = values[i] > middle + arm ? 1 : values[i] < middle - arm ? -1 : 0;
    if (now == 0 || now == side) continue;
    if (side != 0) crossings.push_back(i);
    side = now;
  }
  return crossings;
}

double round_factor(double size, double target) {
  if (!(size > 0.0) || !(target > 0.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(target / size)));
  const double digits = target / size / power;
  return power * (digits >= 5.0 ? 5.0 : digits >= 2.0 ? 2.0 : 1.0);
}

namespace {

/// In four sums at once: one alone waits for itself.
double inner_product(std::span<const double> a, const double* b) {
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

std::vector<double> without_mean(std::span<const double> values) {
  std::vector<double> deviations(values.begin(), values.end());
  const double centre = mean(values);
  for (double& v : deviations) v -= centre;
  return deviations;
}

}  // namespace

std::vector<double> correlation(std::span<const double> a, std::span<const double> b, std::size_t lags,
                                std::size_t step) {
  GAPSCOPE_REQUIRE(a.size() == b.size() && step > 0);
  const std::vector<double> first = without_mean(a);
  const std::vector<double> other = a.data() == b.data() ? std::vector<double>() : without_mean(b);
  const std::vector<double>& later = other.empty() ? first : other;
  const double power = std::sqrt(inner_product(first, first.data()) * inner_product(later, later.data()));
  if (first.empty()) return {};
  std::vector<double> c(std::min(lags, first.size() - 1) / step + 1);
  parallel_for(c.size(), 0, [&](std::size_t i) {
    const std::size_t k = i * step;
    const double sum = inner_product({first.data(), first.size() - k}, &later[k]);
    c[i] = power > 0.0 ? sum / power : kNaN;
  });
  return c;
}

std::vector<double> autocorrelation(std::span<const double> values, std::size_t lags, std::size_t step) {
  return correlation(values, values, lags, step);
}

}  // namespace gapscope::internal::report
