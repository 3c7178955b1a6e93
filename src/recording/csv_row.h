#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gapscope/recording/recording_file.h"
#include "recording/row_clock.h"
#include "recording/table_form.h"

namespace gapscope::internal::recording {

/// The lines of a text one after the other, of whose rows any column may be asked for. Where its table stands
/// and how is known before, or else the first line is its header. Where no commas separate the columns, a
/// number may have a decimal comma; the first number with either mark says which one the file has.
class CsvRow {
 public:
  /// @param name  of the file, for messages
  /// @param form  of its table; where no rows are seen in it, the first line is taken for the names
  CsvRow(std::string name, RecordingColumns columns, TableForm form = {})
      : name_(std::move(name)), columns_(std::move(columns)), form_(std::move(form)) {}

  /// Takes the next line, without its end.  @returns whether it is a row: no header, comment or blank line
  /// @throws ConfigError for a header without the columns, and a row of another width
  bool next(std::string_view line);

  /// Whether the first rows go back in time, each of them.
  bool newest_first();

  // Of the row that was taken last, in SI; NaN where there is nothing, or a word for it.
  // @throws ConfigError where it is no finite number
  double time();
  double input();   ///< times the supply's voltage where there is one; NaN where there is no input
  double supply();  ///< that voltage; 1 without
  double target() { return number(target_, columns_.target, columns_.scales.position); }
  double position() { return number(x1_, columns_.position, columns_.scales.position); }
  double load_position() { return number(x2_, columns_.load_position, columns_.scales.load_position); }

  /// Whether the first field is neither a number nor empty: a line of words, no damaged row.
  bool begins_with_text() const;
  bool has_load_position() const { return x2_.column >= 0; }
  bool has_target() const { return target_.column >= 0; }
  bool has_input() const { return u_.column >= 0; }
  std::int64_t line() const { return line_; }            ///< of the file, from 1
  std::string text_of(const std::string& column) const;  ///< as it stands in the row
  bool reads_clock() const { return clock_.begun(); }    ///< times are counted from the first one on
  const RecordingColumns& columns() const { return columns_; }

  void require_header() const;  ///< @throws ConfigError unless there was one
  [[noreturn]] void fail(const std::string& what) const;

 private:
  /// Where the numbers of a column stand.
  struct Place {
    int column = -1;   ///< from 0; -1: it is not there
    int element = -1;  ///< of the list in each field; -1: the field is the number, or has a list of one
  };

  void header(std::string_view line);
  void settle_columns();
  void check_width() const;
  Place place(const std::string& name, bool required) const;
  Place place_of_time() const;
  int column_of(const std::string& name) const;
  bool same_times(std::size_t a, std::size_t b) const;
  std::string wanted() const;
  std::string wanted_with(const std::string& name) const;
  std::string there() const;
  std::string how_declared(const std::string& name) const;
  std::string_view field(Place place, const std::string& column) const;
  double number(Place place, const std::string& column, const UnitScale& scale);
  double slow_number(std::string_view text, const std::string& column, const UnitScale& scale) const;
  std::string_view with_decimal_point(std::string_view text, const std::string& column);

  std::string name_;
  RecordingColumns columns_;
  TableForm form_;
  RowClock clock_;
  std::vector<std::string_view> fields_;  // of the line that was taken last
  std::string text_;                      // a number that was written with a decimal comma
  char decimal_mark_ = 0;                 // of the first number that has one
  std::size_t width_ = 0;
  std::int64_t line_ = 0, rows_ = 0;
  Place t_, u_, x1_, x2_, voltage_, target_;
  bool has_header_ = false, knows_one_ = false;  // a column that is looked for is in it
};

}  // namespace gapscope::internal::recording
