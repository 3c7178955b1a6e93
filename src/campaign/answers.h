#pragma once

#include <vector>

#include "campaign/summary.h"

namespace gapscope::internal::campaign {

/// A setting is good enough for a tolerance when at least this share of all its runs (those without an answer
/// count as bad) are within it.
constexpr double kGoodShare = 0.9;

/// What each estimator needs for an error of at most 1, 2 and 5 %: for each pair of axes, or for the one axis
/// there is.
std::vector<SummaryAnswer> answers(const CampaignSummary& summary);

/// Which of the values in a row are good, in words: "at least 14 bit", "14 to 18 bit", "any", "none". Values
/// that are no numbers, and those with gaps between them, are listed.
std::string range_in_words(const std::vector<SummaryBin>& bins, const std::vector<bool>& good);

}  // namespace gapscope::internal::campaign
