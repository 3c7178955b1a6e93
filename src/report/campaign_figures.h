#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "results/campaign_summary.h"

namespace gapscope::internal::report {

/// Error, bias, coverage and refusals of both estimators along one axis.
FigureData campaign_line(const CampaignSummary& summary, const SummaryTable& table);

/// Error, refusals, coverage and disagreement over two axes.
FigureData campaign_map(const CampaignSummary& summary, const SummaryTable& table);

/// The values of an axis as named places: without the unit that all of them share, which stands by the name;
/// as letters where they are long texts.
/// @param room  before the first and after the last place
Axis campaign_axis(const SummaryAxis& axis, const Interval& room);

/// "A none, B contact_adhesion": what the letters stand for; empty without.
std::string campaign_key(const SummaryAxis& axis);

/// What each estimator does for how much work; times are no figure, as they are others at each run.
FigureData campaign_cost(const CampaignSummary& summary);

/// The cost, the maps, then the lines.
std::vector<FigureData> campaign_figures(const CampaignSummary& summary);

/// Which estimator to take when, and what that costs.
std::vector<std::string> campaign_verdict(const CampaignSummary& summary);

std::string campaign_text(const CampaignSummary& summary, const std::vector<FigureData>& figures);

/// One of the estimators of a campaign: how it is called and drawn.
struct CampaignEstimator {
  const char* key;
  const char* name;
  const char* in_a_sentence;
  EstimatorScore SummaryCell::*score;
  LineStyle style;
  Marker marker;
};
std::vector<CampaignEstimator> estimators_of(const CampaignSummary& summary);

/// The name of an estimator by its key.
std::string estimator_name(const std::string& key);

/// "0.83 %", "12 %", "0.0021 %": a share for people; "–" for NaN.
std::string percent(double share);

}  // namespace gapscope::internal::report
