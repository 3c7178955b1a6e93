#pragma once

#include <string>
#include <vector>

#include "gapscope/recording/recording_file.h"

namespace gapscope {

/// What stands for the name of an axis in the name of a column: "{axis}.position", "q[:, {axis}]".
inline constexpr const char* kAxisInName = "{axis}";

/// What is said in place of a name for all of them.
inline constexpr const char* kAllAxes = "all";

/// Whether any column is named so.
bool names_an_axis(const RecordingColumns& columns);

/// The columns of one axis.
RecordingColumns columns_of_axis(RecordingColumns columns, const std::string& axis);

/// What a file has that can be named as a column; of a log also with its topic.
/// @throws ConfigError where the file is none
std::vector<std::string> recorded_names(const std::string& path);

/// The axes that a file has a position of, as the position's name says: numbers in their order, others in
/// that of the file.
/// @throws ConfigError where the file is none or has none; as read_recording()
std::vector<std::string> recorded_axes(const std::string& path, const RecordingColumns& columns);

}  // namespace gapscope
