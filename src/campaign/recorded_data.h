#pragma once

#include <string>

#include "gapscope/config/campaign_config.h"

namespace gapscope::internal {

/// A line for every recording that the campaign reads, with the SHA-256 of its bytes: another recording
/// under the same name is another campaign. Empty for simulated data.
std::string recorded_data(const CampaignConfig& campaign);

}  // namespace gapscope::internal
