#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gapscope/recording/recording_file.h"

namespace gapscope::internal::recording {

/// Splits at separators outside quotes; a comment ends the line. The vector is reused: no allocation
/// per row. A line with nothing but blanks and comment gives no field.
void split_fields(std::string_view text, char separator, std::vector<std::string_view>& fields);

/// The lines of a CSV one after the other: the header first, then rows of which any column may be asked for.
/// The header tells what stands between the columns: a comma, a semicolon or a tab. Beside the last two a
/// number may have a decimal comma; the first number with either mark says which one the file has.
class CsvRow {
 public:
  /// @param name  of the file, for messages
  CsvRow(std::string name, RecordingColumns columns) : name_(std::move(name)), columns_(std::move(columns)) {}

  /// Takes the next line, without its end.  @returns whether it is a row: no header, comment or blank line
  /// @throws ConfigError for a header without the columns, and a row of another width
  bool next(std::string_view line);

  // Of the row that was taken last, in SI.  @throws ConfigError where it is no finite number
  double time() { return number(t_, columns_.time, columns_.scales.time); }
  double input();   ///< times the supply's voltage where there is one; NaN where there is no input
  double supply();  ///< that voltage; 1 without
  double target() { return number(target_, columns_.target, columns_.scales.position); }
  double position() { return number(x1_, columns_.position, columns_.scales.position); }
  double load_position() { return number(x2_, columns_.load_position, columns_.scales.load_position); }

  bool has_load_position() const { return x2_ >= 0; }
  bool has_target() const { return target_ >= 0; }
  std::int64_t line() const { return line_; }  ///< of the file, from 1
  const RecordingColumns& columns() const { return columns_; }

  void require_header() const;  ///< @throws ConfigError unless there was one
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void header(std::string_view line);
  void check_width() const;
  int place(const std::string& name, bool required) const;
  std::string wanted() const;
  std::string wanted_with(const std::string& name) const;
  std::string there() const;
  std::string how_declared(const std::string& name) const;
  double number(int place, const std::string& column, const UnitScale& scale);
  std::string_view with_decimal_point(std::string_view text, const std::string& column);

  std::string name_;
  RecordingColumns columns_;
  std::vector<std::string_view> fields_;  // of the line that was taken last
  std::string text_;                      // a number that was written with a decimal comma
  char separator_ = ',';
  char decimal_mark_ = 0;  // of the first number that has one
  std::size_t width_ = 0;
  std::int64_t line_ = 0;
  int t_ = -1, u_ = -1, x1_ = -1, x2_ = -1, voltage_ = -1, target_ = -1;
  bool has_header_ = false, knows_one_ = false;  // a column that is looked for is in it
};

}  // namespace gapscope::internal::recording
