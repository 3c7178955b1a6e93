#pragma once

#include <string>
#include <vector>

#include "campaign/row.h"
#include "campaign/summary.h"

namespace gapscope::internal::campaign {

/// Two estimators on the runs that both answer.
class PairScorer {
 public:
  using Estimate = CampaignEstimate CampaignRow::*;
  PairScorer(std::string first, Estimate first_of, std::string second, Estimate second_of);

  void add(const CampaignRow& row);
  EstimatorPair pair() const;

 private:
  struct Errors {
    double first, second;  ///< over the true gap, signed
  };
  struct Claims {
    double first, second;  ///< errors [rad]
    double first_std, second_std;
  };
  EstimatorPair names_;
  Estimate first_of_, second_of_;
  std::vector<Errors> errors_;
  std::vector<Claims> claims_;
};

/// Pearson's correlation of two normal samples from their ranks, ρ = 2 sin(π ρs/6): a few estimates that are
/// far off do not decide it. NaN for fewer than 10 pairs.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace gapscope::internal::campaign
