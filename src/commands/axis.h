#pragma once

#include <string>
#include <vector>

#include "config/configuration.h"

namespace gapscope {

/// The axes that are meant: the one that is named; of "all" those that the file has; none where it is empty.
/// @throws ConfigError for one that is named where no column has {axis} in its name
std::vector<std::string> asked_axes(const std::string& axis, const std::string& file,
                                    const RecordingColumns& columns);

/// A configuration whose columns are those of this one axis.
/// @throws ConfigError where it has no recording, or no column has {axis} in its name
Configuration of_axis(Configuration configuration, const std::string& axis);

}  // namespace gapscope
