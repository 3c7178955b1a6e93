#pragma once

#include <string>

#include "config/schema_parts.h"
#include "config/yaml_value.h"
#include "gapscope/reference/fit.h"

/// A number that is fixed or fitted, as YAML has it: 3, or {value: 3, estimate: true, bounds: [1, 5]}.
namespace gapscope::internal::config {

/// @throws ConfigError
ParameterSetting read_setting(const Value& value, const Range& range);

/// The text that reads back as it, with a prior where a drive parameter has one.
std::string setting_text(const ParameterSetting& setting);

Json setting_schema(const Range& range, const std::string& doc);

/// The same where the fit does not know where to begin.
Json begun_setting_schema(const Range& range, const std::string& doc);

/// Of a parameter of the drive, which may have a prior, be a guess, or be given at the motor.
Json drive_parameter_schema(const Range& range, const std::string& doc);

}  // namespace gapscope::internal::config
