#pragma once

#include "config/data_config.h"
#include "config/yaml_value.h"
#include "config/yaml_writer.h"

namespace gapscope::internal::config {

/// Turns of a shaft for one of another, at most; as many the other way round.
inline constexpr double kLargestGear = 1e6;

/// `units` and `gear_ratio` of a recording, and the scales that follow.
void read_units(const Section& section, const EncoderConfig& encoder, Coordinates coordinates,
                RecordingConfig& recording);

/// recording: columns, in one line.
std::string columns_text(const RecordingColumns& columns);

/// rate, unwrap and input_rows of a recording, as far as they are not what goes without saying.
void write_rows(YamlWriter& out, const ReadOptions& reading);

/// units, registers and gear_ratio, as far as something was declared.
void write_units(YamlWriter& out, const RecordingConfig& recording);

}  // namespace gapscope::internal::config
