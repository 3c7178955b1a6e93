#pragma once

#include <string>
#include <vector>

#include "gapscope/results/campaign_summary.h"
#include "report/figure_data.h"

namespace gapscope::internal::report {

/// Error, bias, coverage and refusals of both estimators along one axis.
FigureData campaign_line(const CampaignSummary& summary, const SummaryTable& table);

/// Error, refusals, coverage and disagreement over two axes.
FigureData campaign_map(const CampaignSummary& summary, const SummaryTable& table);

/// The maps, then the lines.
std::vector<FigureData> campaign_figures(const CampaignSummary& summary);

std::string campaign_text(const CampaignSummary& summary, const std::vector<FigureData>& figures);

/// One of the two estimators of a campaign: how it is called and drawn.
struct CampaignEstimator {
  const char* name;
  EstimatorScore SummaryCell::*score;
  LineStyle style;
  Marker marker;
};
std::vector<CampaignEstimator> estimators_of(const CampaignSummary& summary);

/// "0.83 %", "12 %", "0.0021 %": a share for people; "–" for NaN.
std::string percent(double share);

}  // namespace gapscope::internal::report
