#pragma once

#include <cstdint>

#include "config/campaign_config.h"

namespace gapscope::internal::config {

/// The base configuration as it stands.  @throws ConfigError
void base_configuration(const CampaignConfig& campaign);

/// A permutation of [0, size) that needs no table: where it sends `index`.
std::uint64_t permuted(std::uint64_t index, std::uint64_t size, std::uint64_t key);

}  // namespace gapscope::internal::config
