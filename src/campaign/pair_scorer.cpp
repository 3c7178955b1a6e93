#include "campaign/pair_scorer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/normal.h"
#include "campaign/score.h"

namespace gapscope::internal::campaign {
namespace {

constexpr std::size_t kFewestPairs = 10;

/// Place of each value among all of them.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<double>(i);
  return rank;
}

/// Fisher's interval of a correlation, wider for ranks.
Interval correlation_ci95(double rho, std::size_t n) {
  constexpr double kOfRanks = 1.03;
  const double half = kNormal95 * kOfRanks / std::sqrt(static_cast<double>(n) - 3.0);
  const double z = std::atanh(std::clamp(rho, -0.999999, 0.999999));
  return {std::tanh(z - half), std::tanh(z + half)};
}

}  // namespace

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  if (x.size() < kFewestPairs) return kNaN;
  const std::vector<double> a = ranks(x), b = ranks(y);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  const double by_ranks = 1.0 - 6.0 * sum / (n * (n * n - 1.0));
  return 2.0 * std::sin(kPi * by_ranks / 6.0);
}

PairScorer::PairScorer(std::string first, Estimate first_of, std::string second, Estimate second_of)
    : first_of_(first_of), second_of_(second_of) {
  names_.first = std::move(first);
  names_.second = std::move(second);
}

void PairScorer::add(const CampaignRow& row) {
  const CampaignEstimate &a = row.*first_of_, &b = row.*second_of_;
  if (!a.answers.value_or(false) || !b.answers.value_or(false) || !(row.true_gap > 0.0)) return;
  const double first = a.gap - row.true_gap, second = b.gap - row.true_gap;
  errors_.push_back({first / row.true_gap, second / row.true_gap});
  const auto claims = [](const CampaignEstimate& e) { return std::isfinite(e.ci95.low) && e.std > 0.0; };
  if (claims(a) && claims(b)) claims_.push_back({first, second, a.std, b.std});
}

EstimatorPair PairScorer::pair() const {
  EstimatorPair p = names_;
  std::vector<double> first, second, advantage;
  for (const Errors& e : errors_) {
    first.push_back(std::abs(e.first));
    second.push_back(std::abs(e.second));
    advantage.push_back(first.back() - second.back());
    p.first_nearer += advantage.back() < 0.0 ? 1 : 0;
  }
  p.both = static_cast<int>(errors_.size());
  p.first_error = median(first);
  p.second_error = median(second);
  p.advantage = median(advantage);
  p.advantage_ci = median_ci95(advantage);
  std::vector<double> x, y;
  for (const Claims& c : claims_) {
    x.push_back(c.first / c.first_std);
    y.push_back(c.second / c.second_std);
  }
  p.claimed = static_cast<int>(claims_.size());
  p.correlation = rank_correlation(x, y);
  if (std::isfinite(p.correlation)) p.correlation_ci = correlation_ci95(p.correlation, claims_.size());
  const double rho = std::isfinite(p.correlation) ? p.correlation : 0.0;
  for (const Claims& c : claims_) {
    const double apart = std::abs(c.first - c.second),
                 variance = c.first_std * c.first_std + c.second_std * c.second_std;
    const double shared = 2.0 * rho * c.first_std * c.second_std;
    p.disagree += apart > kNormal95 * std::sqrt(variance) ? 1 : 0;
    p.disagree_correlated += apart > kNormal95 * std::sqrt(std::max(0.0, variance - shared)) ? 1 : 0;
  }
  return p;
}

}  // namespace gapscope::internal::campaign
