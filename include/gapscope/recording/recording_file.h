#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "gapscope/base/whole_file.h"
#include "gapscope/recording/controller.h"
#include "gapscope/recording/recording.h"
#include "gapscope/recording/units.h"

namespace gapscope {

/// What the units of the columns are in SI; an input without a unit of its own stays as it was recorded.
struct ColumnScales {
  UnitScale time, input, position, load_position, voltage = {};
  /// After so much a position may begin anew, as a single turn does [rad]; 0: it does not turn.
  double turn = 2.0 * std::numbers::pi;
};

/// What a file must have in the column of the input.
enum class InputColumn {
  kRequired,  ///< it is there, or the file is refused
  kOptional,  ///< where there is none, every u is NaN
  kNone,      ///< it is not read: there is only the target
};

/// Names of the columns (of another file than a CSV: its arrays), or where no column has that name its place,
/// from 1; load_position is optional in the file. An element of a list in each cell is "q[:, 0]", as of a
/// table.
struct RecordingColumns {
  std::string time = "t";
  std::string input = "u";
  std::string position = "x1";
  std::string load_position = "x2";
  bool load_position_required = false;  ///< true when the user named the column
  bool position_named = false;          ///< the same for the position
  InputColumn input_column = InputColumn::kRequired;
  ColumnScales scales;
  std::string voltage = {};  ///< of the supply: u is the input, a duty, times it; empty: there is none
  std::string target = {};   ///< of the commanded position, in units of the position; empty: there is none

  bool position_is_speed = false;  ///< the column `position` has the speed, which is integrated over time
  double rate = 0.0;               ///< at which the rows come [Hz]; 0: `time` is the column of their times

  bool reads_input() const { return input_column != InputColumn::kNone; }
  /// Whether an encoder on the load is read from the column load_position; else it is from the one that alone
  /// was named, position.
  bool load_reads_load_position() const { return load_position_required || !position_named; }
  /// The columns with that of an encoder on the load in the place of the position.
  RecordingColumns read_from_load() const;
};

/// What becomes of rows that are not uniform in time.
enum class UnevenRows {
  kRefused,  ///< whoever counts samples as time needs a grid
  kStamped,  ///< taken as they are, each with its time
};

/// What u is over rows that a logger has lost.
enum class LostRows {
  kHeld,     ///< that of the row before: the drive itself kept it, or was late
  kBridged,  ///< a line to the next row: the drive went on getting new ones, see bridge_lost_rows()
};

/// What becomes of a position that begins anew after each turn.
enum class Unwrap {
  kAuto,    ///< it is counted on where it stays within a turn and steps by nearly a whole one
  kAlways,  ///< wherever it steps by more than half a turn
  kNever,
};

struct ReadOptions {
  RecordingColumns columns;
  std::optional<std::pair<double, double>> window;  ///< part of the file that is used [s]
  std::optional<double> resample_rate;              ///< [Hz]; makes any sampling uniform
  UnevenRows uneven = UnevenRows::kRefused;         ///< where they are not resampled
  LostRows lost_rows = LostRows::kHeld;             ///< of rows with their own times
  EncoderSide encoder = EncoderSide::kMotor;        ///< whose position the column `position` is
  std::optional<DriveController> controller;     ///< makes the input of the target, where that was recorded
  double gain_times = 1.0;                       ///< its leading number in this file, over that one [-]
  std::optional<std::pair<double, double>> off;  ///< times between which the drive was switched off [s]
  std::optional<double> voltage;  ///< of the supply in this file, which the duty is a part of [V]
  Unwrap unwrap = Unwrap::kAuto;
  /// By which the recorded input is moved: with -1 that of the next row acts from this one.
  int input_rows = 0;
};

/// No input is moved by more rows than this.
constexpr int kMostInputRows = 100;

/// Fewer samples than this are no recording.
constexpr std::size_t kFewestSamples = 50;

/// Reads a recording: a file named *.mat is MATLAB's (version 4, 5 or 7.3), *.npz NumPy's, *.h5 or *.hdf5 an
/// HDF5, *.mcap and *.db3 logs of robots, *.json and *.jsonl JSON, of which each column is a vector of real
/// numbers, all equally long, or a column of a table, named "q[:, 0]"; any other one is a text with a table,
/// which is found in it: below other lines, with a header, a row of units or neither, `#`, `%` and `//`
/// comments and extra columns ignored; its columns stand between commas, semicolons, tabs or blanks, beside
/// the last three with a decimal comma or point. Times may be those of a clock, and the newest row the first.
/// Short blanks ("nan", nothing) are bridged, longer ones left out; columns that are filled in turn are
/// brought to the rows of the position; wraps are undone, and single rows that jump and come back are drawn
/// between their neighbours. What was done is in `assumed`. Sampling is uniform when every step is within 0.1
/// % of the mean step; anything else is refused with the figure, taken with its stamps, or resampled on
/// request: x1 and x2 linearly, u as the mean of the held input over each new interval, so that its impulse
/// is kept.
/// @throws ConfigError with file and line (sample of an array): missing or empty file, missing column, a
///   field that is no finite number, a row with too few fields, a variable that is no real vector, time that
///   does not increase, non-uniform time (unless it is taken), too few samples, an empty window.
Recording read_recording(const std::string& path, const ReadOptions& options = {});

/// The number that a column or a variable holds all through a file, as a bench stores the mass on its arm.
/// @param columns  of which the time and the rate are taken
/// @throws ConfigError where there is none of that name, or where it changes
double number_of_file(const std::string& path, const std::string& name, const RecordingColumns& columns);

/// Of a recording that has input and target both: what its controller, as declared, makes of the target
/// beside the input that was recorded. Nothing where there is no controller, or no input.
std::optional<InputComparison> compare_with_controller(const std::string& path, const ReadOptions& options);

/// The answer of a user's simulator to the input of a recording: its position, of the side that the encoder
/// of that recording reads, at that recording's times, with that recording's u. The file may have rows
/// between these times. Its input, where it has that column, must be the recorded one.
/// @param columns  those that the recording was read with, whose units its numbers are in
/// @throws ConfigError with file and line, as read_recording() does; for a time of the recording without a
/// row
///   (within a tenth of a step), and for another input (by 0.1 % of its peak)
Recording read_simulated(const std::string& path, const RecordingColumns& columns, const Recording& like);

/// Writes t, u, x1 and, where known, x2 and mode, so that read_recording() returns the same numbers.
/// @throws std::runtime_error if the file cannot be written.
void write_csv(const std::string& path, const Recording& recording, const Replaceable& found = {});

}  // namespace gapscope
