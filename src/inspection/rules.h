#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/remark.h"
#include "gapscope/inspection/inspection.h"
#include "gapscope/recording/recording.h"
#include "inspection/column_guess.h"
#include "recording/recorded_rows.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::inspection {

/// A recording as it is looked at.
struct Material {
  recording::RecordedRows rows;        ///< as they stand in the file
  std::vector<double> register_input;  ///< the input's column as it stands, without unit and supply
  std::vector<double> duty;     ///< where u is a duty times the supply's voltage, this duty at each row
  double position_unit = 1.0;   ///< of the position's column [rad]
  bool commanded = false;       ///< u is what a controller makes of a target
  Recording recording;          ///< the rows on a uniform grid
  signals::SignalFacts signal;  ///< of its x1
  NamedRate named_rate;         ///< where the rows are told to come at a rate: what the file says of it
  bool resampled = false;       ///< on request: also for fit and diagnose, which need no grid
  Coordinates coordinates;
  const char* unit() const { return coordinates.position_unit(); }
  /// "246.4 mm", "50 nm": with the prefix that keeps the number between 1 and 1000.
  std::string length(double position) const {
    return Remark("length", "{:.4g} [rad]", {position}).text(coordinates);
  }
  bool moves() const { return signal.speed_rms > 0.0; }
};

/// "65535", "1764", "1.33", "-0.00042": so many digits, all of a larger number, never "6.55e+04".
inline std::string figure(double value, int digits = 3) {
  const double size = std::abs(value);
  return size >= std::pow(10.0, digits) - 0.5 && size < 1e9 ? fmt::format("{:.0f}", value)
                                                            : fmt::format("{:.{}g}", value, digits);
}

inline bool whole_numbers(std::span<const double> samples) {
  return std::all_of(samples.begin(), samples.end(), [](double v) { return v == std::round(v); });
}

/// Whether encoders are made with so many counts per turn: a power of two, or a round number.
bool is_usual(double counts);

/// Where u cannot be what drives the motor: a commanded position, a duty far beyond one. Nothing: it may be.
/// @param found  what is told of u in any case
std::optional<Finding> impossible_input(const Material& m, const std::string& found);

/// Where u is a magnitude. Nothing: it has its sign.
std::optional<Finding> seeming_input(const Material& m, const std::string& found);
/// Where the mean of u is far from zero.
std::optional<Finding> constant_input(const Material& m, const std::string& found);
/// Where each row's u acted before it.
/// @param uniform  the rows are: on a grid that they were brought to none is the one that acted
std::optional<Finding> seeming_rows(const Material& m, bool uniform, const std::string& found);
/// Where x1 is a speed.
std::optional<Finding> seeming_position(const Material& m);

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
