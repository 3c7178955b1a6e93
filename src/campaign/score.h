#pragma once

#include <vector>

#include "campaign/row.h"
#include "campaign/store.h"
#include "campaign/summary.h"

namespace gapscope::internal::campaign {

/// Takes the estimates of one estimator and says how it did.
class EstimatorScorer {
 public:
  void add(const CampaignEstimate& estimate, double true_gap);
  EstimatorScore score() const;

 private:
  void judge(const CampaignEstimate& estimate, double true_gap);

  EstimatorScore counts_;
  std::vector<double> errors_, widths_, scores_, passes_;  ///< relative, errors signed
};

/// Takes rows one by one and says how the estimators did in all of them.
class Scorer {
 public:
  /// @param header  which of them were asked
  explicit Scorer(const CampaignHeader& header) : header_(header) {}

  void add(const CampaignRow& row);
  SummaryCell cell() const;

 private:
  CampaignHeader header_;
  SummaryCell counts_;
  EstimatorScorer literal_, model_free_, reference_;
};

/// The median's 95 % interval by order statistics, whatever the distribution; NaN for fewer than 6 values.
Interval median_ci95(std::vector<double> values);

}  // namespace gapscope::internal::campaign
