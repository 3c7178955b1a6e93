#pragma once

#include <string>
#include <vector>

#include "config/campaign_config.h"

namespace gapscope::internal::campaign {

/// A line for every recording that the campaign reads, with the SHA-256 of its bytes: another recording
/// under the same name is another campaign. Empty for simulated data.
std::string recorded_data(const CampaignConfig& campaign);

/// Paths of these recordings.
std::vector<std::string> recorded_files(const CampaignConfig& campaign);

/// What a file system tells of files without reading them: another text, another file or another time.
std::string state_of(const std::vector<std::string>& files);

}  // namespace gapscope::internal::campaign
