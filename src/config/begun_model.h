#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/configuration.h"

namespace gapscope {

/// What the name of a fitted model has beyond that of its drive.
inline constexpr std::string_view kFittedSuffix = "_fitted";

/// A model as a configuration that `simulate` runs, as model_yaml() has it, from a state that is known.
/// @param controller  that makes the input of the trace's target; it is then part of what is simulated
std::string model_yaml(const Configuration& configuration, const ReferenceModel& model,
                       const std::string& trace, const MotorTrace& recording, const DriveState<double>& begin,
                       const std::optional<DriveController>& controller = {});

}  // namespace gapscope
