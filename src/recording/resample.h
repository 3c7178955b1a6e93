#pragma once

#include "gapscope/recording/recording.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {

/// The table on a uniform grid from its first row on: x1 and x2 linearly between rows, u as the mean of the
/// held input over each new interval, so that its impulse is kept. The last interval may reach beyond the
/// last row, whose input is held. Fills the series, start, dt and the note `resampling`.
/// @param rate [Hz], > 0
Recording resample(const RecordedRows& table, double rate);

}  // namespace gapscope::internal::recording
