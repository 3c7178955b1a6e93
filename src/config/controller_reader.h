#pragma once

#include "config/configuration.h"
#include "config/schema_parts.h"
#include "config/yaml_value.h"
#include "config/yaml_writer.h"

namespace gapscope::internal::config {

/// `controller: {position: {...}, velocity: {...}}`, which goes with `recording: columns: target:`.
/// @throws ConfigError where one of the two stands alone
void read_controller(const Section& root, Configuration& configuration);

/// Whether u, which a controller makes, is told in units of torque: the torque constant is 1, and no guess.
bool gain_is_torque(const Configuration& configuration);

/// What one unit of its output is: "duty", which the supply's voltage multiplies, "A", or "unit of u".
/// @param is_torque  the torque constant is 1, so that the gain has its size: then "N m/V"
std::string controller_output_unit(bool supplied, bool is_torque, const DeclaredUnits& units,
                                   Coordinates coordinates);
void write_controller(YamlWriter& out, const ControllerModel& model, const std::string& unit_of_output);

Json controller_schema();

/// What has a number of the controller that the fit looks for.
Json sought_by_fit();

}  // namespace gapscope::internal::config
