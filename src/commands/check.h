#pragma once

#include <string>

#include "config/configuration.h"
#include "gapscope/inspection/inspection.h"

namespace gapscope {

/// What `check` tells of a recording.
struct CheckedRecording {
  Inspection inspection;
  std::string json;  ///< the bytes of its file
};

/// Looks at the first recording of a configuration, of which nothing counts but how it is read.
/// @param told_as  what it is called in the answer; empty: its path
/// @throws ConfigError as inspect(); std::logic_error without `recording:`
CheckedRecording checked_recording(const Configuration& reading, Purpose purpose,
                                   const std::string& told_as = "");

/// What of a configuration counts for one of its recordings, those held out behind those that are fitted.
/// @throws ConfigError where it has no recording, or not as many
Configuration reading_of_one(const Configuration& configuration, int index);

}  // namespace gapscope
