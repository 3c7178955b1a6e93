#pragma once

#include "campaign/store.h"
#include "results/campaign_summary.h"

namespace gapscope {

/// What the runs of a campaign say together.
CampaignSummary summarise(const CampaignStore& store);

CampaignTimes times_of(const CampaignStore& store);

}  // namespace gapscope
