#include "sliding_mode/verdict/loop_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/normal.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kNoise = 0.5;          ///< |u| that counts as zero, over the noise of u
constexpr double kAtZero = 0.01;        ///< |u| that counts as zero where u has no noise, over the amplitude
constexpr double kMedianCost = 1.2533;  ///< √(π/2): standard error of a median over that of a mean
constexpr int kReweighted = 40;         ///< steps of the least absolute deviations

/// 97.5 % point of Student's t.
double student(int freedom) {
  constexpr std::array kPoints{12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23};
  const auto place = static_cast<std::size_t>(std::max(freedom, 1) - 1);
  return place < kPoints.size() ? kPoints[place] : kNormal95 + 2.4 / static_cast<double>(freedom - 1);
}

/// Weighted sums of a straight line.
struct LineSums {
  double w = 0.0, u = 0.0, x = 0.0, uu = 0.0, ux = 0.0;
  void add(double weight, double at, double value) {
    w += weight, u += weight * at, x += weight * value;
    uu += weight * at * at, ux += weight * at * value;
  }
  double slope() const {
    const double spread = uu - u * u / w;
    return spread > 1e-12 * uu ? (ux - u * x / w) / spread : 0.0;
  }
};

/// The line of least absolute deviations at u = 0. Deviations below `fine` count by their squares, so that
/// counts which noise has dithered are averaged.
double at_zero(std::span<const double> u, std::span<const double> x, double scale, double fine) {
  double level = median({x.begin(), x.end()}), slope = 0.0;
  for (int step = 0; step < kReweighted; ++step) {
    LineSums sums;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double off = std::abs(x[i] - level - slope * u[i] / scale);
      sums.add(1.0 / std::max(off, fine), u[i] / scale, x[i] - x[0]);
    }
    slope = sums.slope();
    level = x[0] + (sums.x - slope * sums.u) / sums.w;
  }
  return level;
}

double at_zero(const ZeroPassage& p, double fine) {
  double scale = 0.0;
  for (const double u : p.u) scale = std::max(scale, std::abs(u));
  return at_zero(p.u, p.x, scale > 0.0 ? scale : 1.0, fine);
}

double fineness(const MotorTrace& trace, const std::vector<double>& x) {
  const auto [low, high] = std::ranges::minmax(x);
  return std::max({trace.quantum, 1e-9 * (high - low), 1e-15});
}

/// The samples from `from` to `to` whose u is within `width` of zero, and those next to the zero.
ZeroPassage collect(const MotorTrace& trace, std::size_t zero, std::size_t from, std::size_t to,
                    double width) {
  ZeroPassage p;
  p.time = trace.time(zero);
  for (std::size_t i = from; i < to; ++i) {
    const bool near = i + 1 >= zero && i <= zero + 1;
    if (!near && std::abs(trace.u[i]) > width) continue;
    p.u.push_back(trace.u[i]);
    p.x.push_back(trace.x1[i]);
  }
  p.x1 = at_zero(p, fineness(trace, p.x));
  return p;
}

/// The sample of largest |u| from one zero to the next.
std::size_t extreme_between(const std::vector<double>& u, std::size_t from, std::size_t to) {
  std::size_t at = from;
  for (std::size_t i = from; i < to; ++i)
    if (std::abs(u[i]) > std::abs(u[at])) at = i;
  return at;
}

/// Whether u has come back to zero when the recording ends.
bool ends_at_zero(const signals::TorqueCycles& cycles, double amplitude) {
  const std::size_t last = cycles.u.size() - 1, inside = last - std::min(cycles.reach / 2, last);
  const double width = std::max(2.5 * cycles.noise, 0.02 * amplitude);
  return std::abs(cycles.u[inside]) <= width && std::abs(cycles.u[last]) <= width;
}

double pooled(const std::vector<const ZeroPassage*>& ramps, double quantum) {
  std::vector<double> u, x;
  double scale = 0.0;
  for (const ZeroPassage* p : ramps) {
    u.insert(u.end(), p->u.begin(), p->u.end());
    x.insert(x.end(), p->x.begin(), p->x.end());
  }
  for (const double v : u) scale = std::max(scale, std::abs(v));
  const auto [low, high] = std::ranges::minmax(x);
  return at_zero(u, x, scale > 0.0 ? scale : 1.0, std::max({quantum, 1e-9 * (high - low), 1e-15}));
}

/// Sum of the squared deviations of single ramps from their mean.
double scatter(const std::vector<const ZeroPassage*>& ramps) {
  std::vector<double> x;
  for (const ZeroPassage* p : ramps) x.push_back(p->x1);
  const double centre = mean(x);
  double sum = 0.0;
  for (const double v : x) sum += (v - centre) * (v - centre);
  return sum;
}

}  // namespace

std::vector<ZeroPassage> zero_passages(const MotorTrace& trace, const signals::TorqueCycles& cycles) {
  std::vector<ZeroPassage> passages;
  const auto& zeros = cycles.crossings;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const std::size_t before = i > 0 ? zeros[i - 1].sample : 0, zero = zeros[i].sample;
    const std::size_t after = i + 1 < zeros.size() ? zeros[i + 1].sample : trace.size();
    const double width = std::max(kNoise * cycles.noise, kAtZero * zeros[i].before);
    passages.push_back(collect(trace, zero, extreme_between(cycles.u, before, zero),
                               extreme_between(cycles.u, zero, after) + 1, width));
    passages.back().rising = zeros[i].rising;
    passages.back().amplitude = zeros[i].before;
  }
  if (zeros.empty() || !ends_at_zero(cycles, zeros.back().after)) return passages;
  const std::size_t extreme = extreme_between(cycles.u, zeros.back().sample, trace.size());
  const double width = std::max(kNoise * cycles.noise, kAtZero * zeros.back().after);
  passages.push_back(collect(trace, trace.size() - 1, extreme, trace.size(), width));
  passages.back().rising = !zeros.back().rising;
  passages.back().amplitude = zeros.back().after;
  return passages;
}

LoopReading read_loop(std::span<const ZeroPassage* const> passages, double quantum) {
  std::vector<const ZeroPassage*> rising, falling;
  for (const ZeroPassage* p : passages) (p->rising ? rising : falling).push_back(p);
  LoopReading r;
  r.ramps = static_cast<int>(passages.size());
  r.lost_motion = pooled(falling, quantum) - pooled(rising, quantum);
  const int freedom = r.ramps - 2;
  const double variance = (scatter(rising) + scatter(falling)) / std::max(freedom, 1);
  const double n =
      1.0 / (1.0 / static_cast<double>(std::ssize(rising)) + 1.0 / static_cast<double>(std::ssize(falling)));
  // Where counts scatter the ramps, the scatter holds their error already.
  r.half_width = std::max(student(freedom) * kMedianCost * std::sqrt(variance / n),
                          kNormal95 * quantum / std::sqrt(6.0));
  return r;
}

}  // namespace gapscope::internal::sliding_mode
