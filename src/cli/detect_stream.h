#pragma once

#include "cli/commands.h"

namespace gapscope::cli {

/// Reads a CSV from standard input and writes a line of JSON for each passage of the gap as it is completed,
/// first what was learnt, last a summary of all; each is there at once. Ends with its input, with Ctrl-C, or
/// without a word where nobody reads its output any more.
/// @param quantum  of the encoder [rad]; 0: as the samples show
/// @param resample_rate  that the rows are brought to [Hz]; 0: none
/// @throws ConfigError for a broken line, after the summary; Interrupted
void detect_stream(const RecordingColumns& columns, double quantum, double resample_rate = 0.0);

}  // namespace gapscope::cli
