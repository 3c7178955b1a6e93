#pragma once

#include <string>
#include <vector>

#include "gapscope/config/configuration.h"

namespace gapscope::internal::run {

/// The inputs that a controller makes of the targets of recordings that have no other input.
void command_anew(const DriveController& controller, std::vector<Recording>& recordings);

/// Where the controller has numbers to be estimated: they are fitted with the model to the first recordings,
/// and both get the inputs that follow, since a diagnosis needs an input to begin with.
/// @returns what was found, in words; empty where nothing is to be estimated
std::string settle_controller(const Configuration& configuration, std::vector<Recording>& fitted,
                              std::vector<Recording>& held_out);

/// The model that is fitted, its controller settled before.
ReferenceModel settled_model(const Configuration& configuration);

}  // namespace gapscope::internal::run
