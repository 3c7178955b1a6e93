#include "signals/torque_cycles.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"
#include "signals/noise.h"

namespace gapscope::internal::signals {
namespace {

using Samples = std::span<const double>;

double largest_between(Samples u, std::size_t from, std::size_t to) {
  double largest = 0.0;
  for (std::size_t i = from; i < to; ++i) largest = std::max(largest, std::abs(u[i]));
  return largest;
}

struct Passage {
  std::size_t from, to;  ///< last sample beyond the threshold on one side, first one on the other
};

/// Where u goes from beyond the threshold on one side to beyond it on the other.
std::vector<Passage> passages_of_zero(Samples u, double noise) {
  const double threshold = std::max(noise, 0.02 * largest_between(u, 0, u.size()));
  std::vector<Passage> found;
  std::size_t last = u.size();
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (std::abs(u[i]) <= threshold) continue;
    if (last < u.size() && (u[i] > 0.0) != (u[last] > 0.0)) found.push_back({last, i});
    last = i;
  }
  return found;
}

/// Zero of the line through u over a passage.
std::size_t zero_of(Samples u, const Passage& p) {
  const double n = static_cast<double>(p.to - p.from + 1), middle = 0.5 * (n - 1.0);
  double level = 0.0, slope = 0.0;
  for (std::size_t i = p.from; i <= p.to; ++i) {
    level += u[i] / n;
    slope += u[i] * (static_cast<double>(i - p.from) - middle);
  }
  slope /= n * (n * n - 1.0) / 12.0;
  const double zero = std::clamp(middle - level / slope, 0.0, n - 1.0);
  return p.from + static_cast<std::size_t>(std::lround(zero));
}

std::vector<double> smoothed(Samples u, std::size_t reach) {
  std::vector<double> sums(u.size() + 1, 0.0), mean(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) sums[i + 1] = sums[i] + u[i];
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::size_t r = std::min({reach, i, u.size() - 1 - i});
    mean[i] = (sums[i + r + 1] - sums[i - r]) / static_cast<double>(2 * r + 1);
  }
  return mean;
}

ZeroCrossing crossing_at(const MotorTrace& trace, std::size_t sample, std::size_t reach) {
  ZeroCrossing c;
  c.sample = sample;
  const std::size_t from = sample - std::min(reach, sample), to = std::min(sample + reach + 1, trace.size());
  const auto near = trace.x1.subspan(from, to - from);
  c.x1 = mean(near);
  const auto [low, high] = std::minmax_element(near.begin(), near.end());
  c.half_width = 0.5 * (*high - *low);
  return c;
}

double share_that_follows(const MotorTrace& trace, const std::vector<double>& u, std::size_t stride) {
  double with = 0.0, all = 0.0;
  for (std::size_t i = stride; i < u.size(); i += stride) {
    const double moved = trace.x1[i] - trace.x1[i - stride];
    all += std::abs(moved);
    if (moved * (u[i] - u[i - stride]) > 0.0) with += std::abs(moved);
  }
  return all > 0.0 ? with / all : 0.0;
}

}  // namespace

TorqueCycles torque_cycles(const MotorTrace& trace) {
  TorqueCycles cycles;
  if (trace.u.size() != trace.x1.size() || trace.size() < 200) return cycles;
  const double noise = noise_from_differences(trace.u);
  const auto rough = passages_of_zero(trace.u, 5.0 * noise);
  if (rough.size() < 2) return cycles;
  std::vector<double> lengths;
  for (std::size_t i = 1; i < rough.size(); ++i)
    lengths.push_back(static_cast<double>(rough[i].from - rough[i - 1].from));
  const auto reach = static_cast<std::size_t>(0.01 * median(lengths));
  cycles.noise = noise;
  cycles.reach = reach;
  cycles.u = smoothed(trace.u, reach);
  const auto passages = passages_of_zero(cycles.u, 2.5 * noise);
  std::vector<std::size_t> zeros;
  for (const Passage& p : passages) zeros.push_back(zero_of(cycles.u, p));
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    ZeroCrossing c = crossing_at(trace, zeros[i], reach);
    c.rising = cycles.u[passages[i].to] > 0.0;
    c.before = largest_between(cycles.u, i > 0 ? zeros[i - 1] : 0, zeros[i]);
    c.after = largest_between(cycles.u, zeros[i], i + 1 < zeros.size() ? zeros[i + 1] : trace.size());
    cycles.crossings.push_back(c);
  }
  cycles.following = share_that_follows(trace, cycles.u, 6 * reach + 1);
  return cycles;
}

std::vector<double> branch_positions(const MotorTrace& trace, const TorqueCycles& cycles,
                                     std::size_t crossing, double amplitude, std::size_t bins) {
  const auto& all = cycles.crossings;
  const double sign = all[crossing].rising ? 1.0 : -1.0;
  const std::size_t from = crossing > 0 ? all[crossing - 1].sample : 0;
  const std::size_t to = crossing + 1 < all.size() ? all[crossing + 1].sample : trace.size();
  std::size_t i = from;  // the last sample at the extreme from which the branch starts
  for (std::size_t k = from; k < all[crossing].sample; ++k)
    if (sign * cycles.u[k] <= sign * cycles.u[i]) i = k;
  std::vector<double> positions;
  for (std::size_t edge = 0; edge <= bins; ++edge) {
    const double u = amplitude * (2.0 * static_cast<double>(edge) / static_cast<double>(bins) - 1.0);
    while (i < to && sign * cycles.u[i] < u) ++i;
    if (i == to) return {};
    positions.push_back(sign * trace.x1[i]);
  }
  return positions;
}

}  // namespace gapscope::internal::signals
