#pragma once

#include <string>

#include "gapscope/campaign/summary.h"

namespace gapscope {

/// Writes campaign.json into an existing folder.  @throws std::runtime_error naming what cannot be written.
void write_campaign_summary(const std::string& folder, const CampaignSummary& summary);

/// Reads back exactly what was written.  @throws ConfigError for another schema or a damaged file.
CampaignSummary read_campaign_summary(const std::string& folder);

bool has_campaign_summary(const std::string& folder);

}  // namespace gapscope
