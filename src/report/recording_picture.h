#pragma once

#include <string>
#include <vector>

#include "base/input_facts.h"
#include "gapscope/base/coordinates.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

/// What `check` saw, as a picture: input and position over time, the steps of time where they are not even,
/// and the position over the input.
/// @param lines  stand below the title, in plain words
/// @returns the bytes of a PNG
std::string recording_picture(const Recording& recording, Coordinates coordinates, const InputFacts& input,
                              const std::vector<std::string>& lines);

}  // namespace gapscope
