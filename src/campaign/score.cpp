#include "campaign/score.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::campaign {

void EstimatorScorer::add(const CampaignEstimate& e, double true_gap) {
  ++counts_.runs;
  counts_.denied += e.outcome == "none" ? 1 : 0;
  if (std::isfinite(e.passes)) passes_.push_back(e.passes);
  if (!e.answers.value_or(false)) return;
  ++counts_.answered;
  if (true_gap > 0.0) judge(e, true_gap);
}

void EstimatorScorer::judge(const CampaignEstimate& e, double true_gap) {
  constexpr double kPenalty = 2.0 / 0.05;  // of the interval score, for an interval of 95 %
  const double error = (e.gap - true_gap) / true_gap;
  ++counts_.judged;
  counts_.within_1 += std::abs(error) <= 0.01 ? 1 : 0;
  counts_.within_2 += std::abs(error) <= 0.02 ? 1 : 0;
  counts_.within_5 += std::abs(error) <= 0.05 ? 1 : 0;
  errors_.push_back(error);
  const auto& [low, high] = e.ci95;
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  const int holds = low <= true_gap && true_gap <= high ? 1 : 0;
  ++counts_.claimed;
  counts_.covered += holds;
  if (e.trust == "good") ++counts_.good, counts_.good_covered += holds;
  widths_.push_back((high - low) / true_gap);
  const double outside = std::max({0.0, low - true_gap, true_gap - high});
  scores_.push_back((high - low + kPenalty * outside) / true_gap);
}

EstimatorScore EstimatorScorer::score() const {
  EstimatorScore score = counts_;
  std::vector<double> sizes;
  for (const double e : errors_) sizes.push_back(std::abs(e));
  score.median_error = median(sizes);
  score.error_90 = quantile(sizes, 0.9);
  score.bias = median(errors_);
  score.bias_ci = median_ci95(errors_);
  score.median_width = median(widths_);
  score.interval_score = mean(scores_);
  score.passes = median(passes_);
  return score;
}

void Scorer::add(const CampaignRow& row) {
  ++counts_.runs;
  if (!row.error.empty()) {
    ++counts_.failed;
    return;
  }
  if (header_.literal) literal_.add(row.literal, row.true_gap);
  if (header_.model_free) model_free_.add(row.model_free, row.true_gap);
  if (header_.reference) reference_.add(row.reference, row.true_gap);
  if (!row.agree) return;
  ++counts_.both;
  if (*row.agree) return;
  ++counts_.disagree;
  const bool nearer =
      std::abs(row.model_free.gap - row.true_gap) < std::abs(row.reference.gap - row.true_gap);
  counts_.model_free_nearer += nearer ? 1 : 0;
}

SummaryCell Scorer::cell() const {
  SummaryCell cell = counts_;
  cell.literal = literal_.score();
  cell.model_free = model_free_.score();
  cell.reference = reference_.score();
  return cell;
}

Interval median_ci95(std::vector<double> values) {
  const std::size_t n = values.size();
  const auto probability = [&](std::size_t k) {  // that k of n lie below the median
    const double below = static_cast<double>(k), above = static_cast<double>(n - k);
    const double all = below + above;
    return std::exp(std::lgamma(all + 1.0) - std::lgamma(below + 1.0) - std::lgamma(above + 1.0) -
                    all * std::log(2.0));
  };
  std::size_t k = 0;
  for (double share = probability(0); share <= 0.025; share += probability(++k)) {
  }
  if (k == 0) return {};
  std::sort(values.begin(), values.end());
  return {values[k - 1], values[n - k]};
}

}  // namespace gapscope::internal::campaign
