#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/commands.h"

namespace gapscope::cli {

/// How a drive's own tools write recordings; the table is presets.inc.
struct DrivePreset {
  const char* name;
  const char* what;
  const char* time;  ///< names that it may have, with | between them; NAME=UNIT has a unit of its own
  const char* time_unit;
  const char* input;
  const char* input_unit;
  int input_register;
  const char* position;
  const char* position_unit;
  int bits;  ///< of the encoder; 0: not known
  const char* voltage;
  const char* voltage_unit;
  const char* note;        ///< what to know of it
  const char* other_unit;  ///< what to know of an input that has a unit of its own
};

std::span<const DrivePreset> drive_presets();

/// Everything that was not given beside it, as the preset has it. An input of another name than the preset's
/// may be another quantity: it keeps the unit that it was given, or none.
/// @throws ConfigError where the file has none of its columns
RecordingArguments with_preset(RecordingArguments arguments);

/// What it is and what to know of it, where its input is the one that is read; empty without a preset.
std::string preset_banner(const RecordingArguments& arguments);

/// What of the preset does not hold, or holds for a column of another name; empty without a preset.
std::vector<std::string> preset_remarks(const RecordingArguments& arguments);

}  // namespace gapscope::cli
