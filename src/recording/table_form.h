#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gapscope/base/remark.h"

namespace gapscope::internal::recording {

/// In place of a separator: any number of blanks.
inline constexpr char kBlanks = ' ';

/// What stands in a field of a table.
enum class FieldKind {
  kBlank,   ///< nothing, or a word for it: "nan", "null"
  kNumber,  ///< with a decimal point or comma
  kStamp,   ///< a date, a time of the clock, or both
  kList,    ///< "[0.1, 0.2]"
  kText,
};

FieldKind kind_of_field(std::string_view field);

/// Whether a field has nothing, or a word for it.
bool is_blank_field(std::string_view field);

/// Whether the fields may be the units of columns: a row below their names.
bool are_units(const std::vector<std::string_view>& fields);

/// Whether a line is a comment as a whole.
bool is_comment(std::string_view line);

/// Splits at separators outside quotes; a comment ends the line. The vector is reused: no allocation
/// per row. A line with nothing but blanks and comment gives no field.
void split_fields(std::string_view text, char separator, std::vector<std::string_view>& fields);

/// Where in a text its table stands, and how.
struct TableForm {
  char separator = ',';
  std::int64_t header = 0;                     ///< line of the names, from 1; 0: there is none
  std::int64_t first = 0;                      ///< line of the first row; 0: no rows are seen
  std::vector<std::string> names;              ///< of the columns; of a table without a header their places
  std::vector<std::string> units;              ///< that stand below the names; empty: no such row
  std::vector<std::vector<std::string>> rows;  ///< the first ones
  std::vector<Remark> told = {};               ///< what of this does not go without saying
};

/// The table of a text: its rows are the lines that have as many fields as most, where most have numbers in
/// the same columns; its names stand in the line above the first of them, in a comment, or nowhere.
/// @param head  the first lines of the text
TableForm find_table(std::string_view head);

/// Whether a file is a text with a table, by its name: it is of no kind that has arrays.
bool is_text_table(const std::string& path);

/// Of a file.  @throws ConfigError where it cannot be read
TableForm table_of(const std::string& path);

}  // namespace gapscope::internal::recording
