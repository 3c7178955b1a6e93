#include "gapscope/plant/drive.h"

#include <algorithm>
#include <iterator>

#include "base/require.h"

namespace gapscope {

int drive_parameter_index(std::string_view key) {
  const auto* found = std::find_if(std::begin(kDriveParameters), std::end(kDriveParameters),
                                   [&](const DriveParameterSpec& spec) { return key == spec.key; });
  GAPSCOPE_REQUIRE(found != std::end(kDriveParameters));
  return static_cast<int>(found - std::begin(kDriveParameters));
}

}  // namespace gapscope
