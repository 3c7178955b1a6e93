#pragma once

#include <span>
#include <string>

#include "config/data_config.h"
#include "config/starter.h"
#include "gapscope/base/coordinates.h"

namespace gapscope::internal::config {

/// The structure of a first model, and why it is that one.
struct StarterChoice {
  StarterModel structure = StarterModel::kGap;
  std::string why;
  bool seen = true;  ///< or asked for: no guess
};

/// As asked for; where nobody asks, as the detector sees it.
StarterChoice chosen_structure(StarterModel model, std::span<const MotorTrace> traces, EncoderSide encoder,
                               Coordinates coordinates);

/// That of a simulator's model, unless it knows of no gap and the detector does.
StarterChoice as_modelled(const JointNumbers& numbers, std::span<const MotorTrace> traces,
                          EncoderSide encoder, Coordinates coordinates);

/// Which of the first recording and the first that is held out is better fitted, and why: both are read as
/// diagnose would. Where they are better turned round it ends with the command that does so.
/// @param options  of that command beside the recordings
/// @throws ConfigError where a recording cannot be read
std::string order_told(const RecordingConfig& recording, const std::string& options, Coordinates coordinates);

}  // namespace gapscope::internal::config
