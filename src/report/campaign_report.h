#pragma once

#include <string>
#include <vector>

#include "report/figure_formats.h"
#include "results/campaign_summary.h"

namespace gapscope {

/// Which estimator to take when, and what that costs: three sentences; one where no true gap is known.
std::vector<std::string> which_estimator(const CampaignSummary& summary);

/// Draws all figures (PNG) and report.md of a campaign from its campaign.json alone.
/// @throws ConfigError where there is none; std::runtime_error when a file cannot be written.
void write_campaign_report(const std::string& folder, const FigureFormats& formats = {});

}  // namespace gapscope
