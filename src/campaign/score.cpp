#include "campaign/score.h"

#include <cmath>

namespace gapscope::internal::campaign {
namespace {

bool is_interval(const Interval& i) { return std::isfinite(i.low) && std::isfinite(i.high); }

void judge(double estimate, const Interval& ci95, double true_gap, EstimatorScore& score,
           std::vector<double>& errors) {
  ++score.answered;
  if (!(true_gap > 0.0)) return;
  const double error = (estimate - true_gap) / true_gap;
  ++score.judged;
  score.covered += ci95.low <= true_gap && true_gap <= ci95.high ? 1 : 0;
  score.within_1 += std::abs(error) <= 0.01 ? 1 : 0;
  score.within_2 += std::abs(error) <= 0.02 ? 1 : 0;
  score.within_5 += std::abs(error) <= 0.05 ? 1 : 0;
  errors.push_back(error);
}

void finish(EstimatorScore& score, const std::vector<double>& errors) {
  std::vector<double> sizes;
  for (const double e : errors) sizes.push_back(std::abs(e));
  score.median_error = median(sizes);
  score.error_90 = quantile(sizes, 0.9);
  score.bias = median(errors);
}

}  // namespace

void Scorer::add(const CampaignRow& row) {
  ++counts_.runs;
  if (!row.error.empty()) {
    ++counts_.failed;
    return;
  }
  if (model_free_) {
    ++counts_.model_free.runs;
    counts_.model_free.denied += row.verdict == "none" ? 1 : 0;
    if (std::isfinite(row.gap) && is_interval(row.ci95))
      judge(row.gap, row.ci95, row.true_gap, counts_.model_free, model_free_errors_);
  }
  if (reference_) {
    ++counts_.reference.runs;
    if (row.status == "converged" && is_interval(row.reference_ci95))
      judge(row.reference_gap, row.reference_ci95, row.true_gap, counts_.reference, reference_errors_);
  }
  if (!row.agree) return;
  ++counts_.both;
  if (*row.agree) return;
  ++counts_.disagree;
  const bool nearer = std::abs(row.gap - row.true_gap) < std::abs(row.reference_gap - row.true_gap);
  counts_.model_free_nearer += nearer ? 1 : 0;
}

SummaryCell Scorer::cell() const {
  SummaryCell cell = counts_;
  finish(cell.model_free, model_free_errors_);
  finish(cell.reference, reference_errors_);
  return cell;
}

}  // namespace gapscope::internal::campaign
