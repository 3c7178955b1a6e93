#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/configuration.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::run {

/// The inputs that a controller makes of the targets of recordings that have no other input.
void command_anew(const DriveController& controller, std::vector<Recording>& recordings);

/// The controller that a diagnosis begins with.
struct SettledController {
  std::optional<DriveController> known;   ///< that made the inputs; none: they were recorded
  std::optional<ControllerModel> sought;  ///< each step of the diagnosis estimates it anew, from here
  std::string said;  ///< that nothing determines it, in words; empty: it is, or nothing is to
                     ///< be estimated
};

/// Where the controller has numbers to be estimated: they are fitted with the model as it is to the first
/// recordings, and both get the inputs that follow, since a diagnosis needs an input to begin with. Numbers
/// that the recordings do not determine are taken as known from then on, and it is said with which others
/// they change.
SettledController settle_controller(const Configuration& configuration, std::vector<Recording>& fitted,
                                    std::vector<Recording>& held_out);

/// The controller's numbers by a fit of what the diagnosis has come to, in words; empty where there is none.
/// Where that leaves more than the encoder does, with what they are confounded: what they are with the effect
/// that comes nearest to what is missing.
std::string controller_found(const Configuration& configuration, const Diagnosis& diagnosis,
                             const std::vector<Recording>& fitted);

/// The model that is diagnosed, under such a controller.
ReferenceModel diagnosed_model(const Configuration& configuration,
                               const std::optional<ControllerModel>& sought);

}  // namespace gapscope::internal::run
