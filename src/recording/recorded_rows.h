#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gapscope/recording/recording_file.h"
#include "recording/array_file.h"

namespace gapscope::internal::recording {

/// What becomes of a row whose time is not later than that of the row before.
enum class EarlierRow { kRefused, kSkipped };

using Numbers = std::vector<double>;

/// A field of a row that has no number.
struct BlankField {
  std::int64_t line = 0;
  std::string column, text;
};

/// The rows of a recording as they stand in its file, in SI, with the place of each.
struct RecordedRows {
  std::string path;
  std::string row = "line";    ///< what `line` counts: the lines of a text, else samples or messages
  std::vector<double> t;       ///< [s], strictly increasing
  std::vector<double> u;       ///< [unit of u]; NaN in every row where the file has none
  std::vector<double> x1;      ///< [rad]
  std::vector<double> x2;      ///< [rad]; empty if the file has none
  std::vector<double> target;  ///< [rad]; empty where none is read
  std::vector<double> supply;  ///< beside the target: what an input is multiplied by [V]; 1 without
  std::shared_ptr<const CommandRows> command;  ///< what u was made of; null: it was recorded
  std::size_t command_first = 0;               ///< the row of it that is the first here
  std::vector<std::int64_t> line;              ///< of each row, from 1
  std::vector<std::int64_t> skipped;  ///< lines of rows that were left out: not later than the row before
  bool open_end = false;              ///< the last line has no end: its last number may be cut off
  bool has_input = true;              ///< the file has u
  bool integrated = false;            ///< x1 is the integral of a speed
  bool newest_first = false;          ///< time falls from row to row, until reverse()
  std::vector<BlankField> blanks;     ///< the first of each column; the numbers are NaN there
  std::size_t without_time = 0;       ///< rows that were left out for that
  std::vector<Remark> assumed;        ///< how the file was read, and what was mended

  std::size_t size() const { return t.size(); }
  void keep(std::size_t first, std::size_t count);  ///< drops all other rows

  void leave_out(BlankField time);  ///< a row that has no time
  void reverse();                   ///< the last row becomes the first
  void shift_time(double by);

  /// Whether a row of this time goes on where the rows before it end; one that is skipped is noted.
  /// @throws ConfigError for one that is refused, and for one too many
  bool admits(double time, std::int64_t of_line, EarlierRow earlier, const std::string& column);

  /// @throws ConfigError "file:line: what" or, of another row than a line, "file: sample N: what"
  [[noreturn]] void fail(std::int64_t of_line, const std::string& what) const;

  std::string place(std::int64_t of_line) const;  ///< "line 12" or "sample 12"
};

/// By the name of the file: read_csv() or, of a kind that has arrays, read_arrays().  @throws ConfigError,
/// see read_recording().
RecordedRows read_rows(const std::string& path, const RecordingColumns& columns,
                       EarlierRow earlier = EarlierRow::kRefused);
RecordedRows read_csv(const std::string& path, const RecordingColumns& columns, EarlierRow earlier);
std::vector<std::string> csv_names(const std::string& path);  ///< of its columns; empty where there are none

/// The numbers of one column or array as they stand.
/// @param columns  of which a text takes the time, or the rate
Numbers column_numbers(const std::string& path, const std::string& name, const RecordingColumns& columns);

/// Fields without a number: at most two in a row are bridged, further rows left out. Where a column is filled
/// in some rows only, as where each row is of one topic, the others are brought to the rows of the position.
/// @throws ConfigError where too few rows are left
void settle_blanks(RecordedRows& table);

/// Wraps, jumps and what else is mended before a recording is cut to its window.
void mend_rows(const ReadOptions& options, RecordedRows& table);

RecordedRows read_arrays(ArrayFile& file, const std::string& path, const RecordingColumns& columns,
                         EarlierRow earlier);

/// @throws ConfigError unless it is a file of a size that is read
void require_recording_file(const std::string& path);

/// @throws ConfigError, MachineError, see open_input_file()
std::ifstream open_recording_file(const std::string& path);

/// The rows of the window, kFewestSamples or more.  @throws ConfigError
RecordedRows read_window(const std::string& path, const ReadOptions& options,
                         EarlierRow earlier = EarlierRow::kRefused);

/// Mean time from row to row [s].
double mean_step(const RecordedRows& table);

/// The row whose step from the row before is farthest off the mean step.
std::size_t worst_step(const RecordedRows& table);

bool is_uniform(const RecordedRows& table);

/// The columns as they stand, with the time of each row where they are not uniform.
/// @throws ConfigError for uneven rows that are refused
Recording recording_of(RecordedRows&& table, UnevenRows uneven);
Recording uniform_recording(RecordedRows&& table);  ///< uneven rows refused

}  // namespace gapscope::internal::recording
