#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "gapscope/inspection/inspection.h"
#include "gapscope/recording/recording.h"
#include "recording/recorded_rows.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::inspection {

/// A recording as it is looked at.
struct Material {
  recording::RecordedRows rows;  ///< as they stand in the file
  Recording recording;           ///< the same on a uniform grid
  signals::SignalFacts signal;   ///< of its x1
  bool resampled = false;        ///< on request: also for fit and diagnose, which need no grid
  Coordinates coordinates;
  const char* unit() const { return coordinates.position_unit(); }
  bool moves() const { return signal.speed_rms > 0.0; }
};

inline bool whole_numbers(std::span<const double> samples) {
  return std::all_of(samples.begin(), samples.end(), [](double v) { return v == std::round(v); });
}

/// One question each; fills the facts that it finds.
Finding check_time(const Material& m, RecordingFacts& facts);
Finding check_position_unit(const Material& m, RecordingFacts& facts);
Finding check_encoder(const Material& m, RecordingFacts& facts);
Finding check_jumps(const Material& m, RecordingFacts& facts);
Finding check_hold(const Material& m, RecordingFacts& facts);
Finding check_travel(const Material& m, RecordingFacts& facts);
Finding check_periods(const Material& m, RecordingFacts& facts);
Finding check_speed(const Material& m, RecordingFacts& facts);
Finding check_rest(const Material& m, RecordingFacts& facts);
Finding check_input(const Material& m, RecordingFacts& facts);
Finding check_clipping(const Material& m, RecordingFacts& facts);
Finding check_spectrum(const Material& m, RecordingFacts& facts);
Finding check_sign(const Material& m, RecordingFacts& facts);
Finding check_scale(const Material& m, RecordingFacts& facts);
Finding check_feedback(const Material& m, RecordingFacts& facts);
Finding check_repeats(const Material& m, RecordingFacts& facts);

}  // namespace gapscope::internal::inspection
