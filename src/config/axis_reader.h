#pragma once

#include <cstdint>
#include <string>

#include "config/campaign_config.h"
#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// Counts in a campaign end here, far above what is accepted: so that a product of them can still be told.
constexpr std::uint64_t kMostCounted = 1000000000000000;

/// An axis of which the values are only counted so far.
struct WrittenAxis {
  CampaignAxis axis;
  std::uint64_t count = 0;
  std::uint64_t first_seed = 1;
};

/// @param continuous  a range may be without a count
WrittenAxis read_axis(const std::string& path, const Value& value, bool continuous);

/// The axis with its values.
CampaignAxis filled(WrittenAxis written);

CampaignDraw read_draw(const std::string& path, const Value& value);

/// A number as a configuration has it, with at most `digits` significant digits; `number` is what that text
/// says.
AxisValue axis_number(double value, int digits);

}  // namespace gapscope::internal::config
