#pragma once

#include "config/data_config.h"
#include "config/yaml_value.h"

namespace gapscope::internal::config {

/// At which the rows of a file without times may come.
inline constexpr Range kRowRates = {1e-3, 1e7, "Hz"};

/// @param folder  of the configuration, to which paths are relative
RecordingConfig read_recording_block(const Value& value, const std::string& folder,
                                     const EncoderConfig& encoder, Coordinates coordinates);

EncoderConfig read_encoder(const Value& value, Coordinates coordinates);

/// Of the encoder that is read, seen on the axis of x1 [rad]; 0: not given.
double position_quantum(const EncoderConfig& encoder, const RecordingConfig& recording);

/// All but the plant. `model` of the block is left to the caller.
SimulationConfig read_simulation(const Value& value, const std::string& folder);
std::optional<Value> simulated_model(const Value& value);

}  // namespace gapscope::internal::config
