#include "reference/residual_tests.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"

namespace gapscope::internal::reference {
namespace {

constexpr int kMostTestedLags = 40;

/// One recording's residual and input, without their means.
struct Pair {
  std::vector<double> e, u;
  double dt = 0.0;
};

std::vector<double> centred(std::span<const double> values) {
  std::vector<double> v(values.begin(), values.end());
  const double middle = mean(v);
  for (double& x : v) x -= middle;
  return v;
}

std::vector<Pair> pairs_of(const FitProblem& problem, bool free_run, const FitSummary& summary) {
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < summary.traces.size(); ++r) {
    const MotorTrace& recording = problem.recordings[r];
    const std::vector<double>& x1 = free_run ? summary.traces[r].position() : summary.traces[r].predicted;
    if (x1.empty()) continue;
    std::vector<double> e(x1.size());
    for (std::size_t i = 0; i < e.size(); ++i) e[i] = recording.x1[i] - x1[i];
    pairs.push_back({centred(e), centred(recording.u), recording.dt});
  }
  return pairs;
}

/// Σ a_i b_{i+k} over all recordings.
double product(const std::vector<Pair>& pairs, std::size_t lag, std::vector<double> Pair::*first,
               std::vector<double> Pair::*second) {
  double sum = 0.0;
  for (const Pair& p : pairs)
    for (std::size_t i = 0; i + lag < p.e.size(); ++i) sum += (p.*first)[i] * (p.*second)[i + lag];
  return sum;
}

std::vector<std::size_t> lags_of(const std::vector<Pair>& pairs) {
  std::size_t longest = 0;
  for (const Pair& p : pairs) longest = std::max(longest, p.e.size() / 10);
  std::vector<std::size_t> lags;
  for (int i = 0; i < kMostTestedLags && longest > 0; ++i) {
    const auto lag = static_cast<std::size_t>(
        std::lround(std::pow(static_cast<double>(longest), i / (kMostTestedLags - 1.0))));
    if (lags.empty() || lag > lags.back()) lags.push_back(lag);
  }
  return lags;
}

ResidualTest judged(const std::vector<double>& correlation, const std::vector<std::size_t>& lags, double band,
                    double dt) {
  ResidualTest test{0.0, 0.0, kNaN};
  for (std::size_t i = 0; i < lags.size(); ++i) {
    const double size = std::abs(correlation[i]) / band;
    if (size > 1.0) test.outside += 1.0 / static_cast<double>(lags.size());
    if (size <= test.worst) continue;
    test.worst = size;
    test.worst_lag = dt * static_cast<double>(lags[i]);
  }
  return test;
}

}  // namespace

void test_residuals(const FitProblem& problem, bool free_run, FitSummary& summary) {
  const std::vector<Pair> pairs = pairs_of(problem, free_run, summary);
  const std::vector<std::size_t> lags = lags_of(pairs);
  const double ee = product(pairs, 0, &Pair::e, &Pair::e), uu = product(pairs, 0, &Pair::u, &Pair::u);
  if (lags.empty() || !(ee > 0.0)) return;
  double samples = 0.0;
  for (const Pair& p : pairs) samples += static_cast<double>(p.e.size());
  const double band = kNormal95 / std::sqrt(samples);
  std::vector<double> own, with_input;
  double bartlett = 1.0;  // the sum over all lags, by the trapezium rule between those that are looked at
  double before = 1.0, before_lag = 0.0;
  for (const std::size_t lag : lags) {
    own.push_back(product(pairs, lag, &Pair::e, &Pair::e) / ee);
    if (!(uu > 0.0)) continue;
    with_input.push_back(product(pairs, lag, &Pair::u, &Pair::e) / std::sqrt(uu * ee));
    const double both = own.back() * product(pairs, lag, &Pair::u, &Pair::u) / uu,
                 at = static_cast<double>(lag);
    bartlett += at - before_lag > 1.0 ? (before + both) * (at - before_lag) : 2.0 * both;
    before = both, before_lag = at;
  }
  summary.whiteness = judged(own, lags, band, pairs.front().dt);
  if (uu > 0.0)
    summary.input_correlation =
        judged(with_input, lags, band * std::sqrt(std::max(1.0, bartlett)), pairs.front().dt);
}

}  // namespace gapscope::internal::reference
