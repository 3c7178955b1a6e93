#pragma once

#include <vector>

#include "gapscope/campaign/row.h"
#include "gapscope/campaign/summary.h"

namespace gapscope::internal::campaign {

/// Takes rows one by one and says how the estimators did in all of them.
class Scorer {
 public:
  /// @param model_free, reference  which of both were asked
  Scorer(bool model_free, bool reference) : model_free_(model_free), reference_(reference) {}

  void add(const CampaignRow& row);
  SummaryCell cell() const;

 private:
  bool model_free_, reference_;
  SummaryCell counts_;
  std::vector<double> model_free_errors_, reference_errors_;  ///< signed, relative
};

}  // namespace gapscope::internal::campaign
