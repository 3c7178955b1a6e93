#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/csv_row.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

/// The lines of a file, each until the next one is asked for.
class TextLines {
 public:
  explicit TextLines(const std::string& path) : in_(open_recording_file(path)), path_(path) {}

  bool next(std::string_view& line) {
    const char* end = nullptr;
    while (!(end = static_cast<const char*>(std::memchr(buffer_.data() + begin_, '\n', end_ - begin_))) &&
           fill()) {
    }
    if (end == nullptr && begin_ == end_) return false;
    open_end_ = end == nullptr;
    const std::size_t stop = end == nullptr ? end_ : static_cast<std::size_t>(end - buffer_.data());
    line = std::string_view(buffer_).substr(begin_, stop - begin_);
    begin_ = std::min(stop + 1, end_);
    return true;
  }

  bool open_end() const { return open_end_; }  ///< the last one that was given out has no end

 private:
  /// More of the file behind what is left.  @returns false where there is no more
  bool fill() {
    constexpr std::size_t kPiece = 1 << 18;
    buffer_.erase(0, begin_);
    end_ -= begin_, begin_ = 0;
    buffer_.resize(end_ + kPiece);
    in_.read(buffer_.data() + end_, kPiece);
    if (in_.bad()) throw MachineError(path_ + ": cannot be read to its end");
    end_ += static_cast<std::size_t>(in_.gcount());
    return in_.gcount() > 0;
  }

  std::ifstream in_;
  std::string path_, buffer_;
  std::size_t begin_ = 0, end_ = 0;
  bool open_end_ = false;
};

/// Adds numbers of a row; those that are none are noted.
class RowTaker {
 public:
  RowTaker(CsvRow& row, RecordedRows& table) : row_(row), table_(table) {}

  void add(EarlierRow earlier) {
    const RecordingColumns& columns = row_.columns();
    const double t = row_.time();
    if (std::isnan(t)) return table_.leave_out({row_.line(), columns.time, row_.text_of(columns.time)});
    if (!table_.t.empty() && t == table_.t.back() && joins_last()) return;
    if (!table_.admits(t, row_.line(), earlier, columns.time)) return;
    table_.t.push_back(t);
    table_.u.push_back(row_.input());
    table_.x1.push_back(row_.position());
    if (row_.has_input() && std::isnan(table_.u.back())) note(columns.input, 1);
    if (std::isnan(table_.x1.back())) note(columns.position, 2);
    if (row_.has_load_position()) table_.x2.push_back(row_.load_position());
    if (row_.has_load_position() && std::isnan(table_.x2.back())) note(columns.load_position, 3);
    if (row_.has_target()) table_.target.push_back(row_.target()), table_.supply.push_back(row_.supply());
    if (row_.has_target() && std::isnan(table_.target.back() + table_.supply.back())) note(columns.target, 4);
    table_.line.push_back(row_.line());
  }

  long joined() const { return joined_; }  ///< rows that filled the blanks of the one before

 private:
  /// Puts the numbers of a row into the blanks of the last one, unless both have one in some column.
  bool joins_last() {
    std::pair<Numbers*, double> columns[] = {
        {&table_.x1, row_.position()},
        {&table_.u, row_.input()},
        {&table_.x2, row_.has_load_position() ? row_.load_position() : kNaN},
        {&table_.target, row_.has_target() ? row_.target() : kNaN}};
    bool any = false;
    for (const auto& [column, value] : columns) {
      if (column->empty() || std::isnan(value)) continue;
      if (!std::isnan(column->back())) return false;
      any = true;
    }
    for (const auto& [column, value] : columns)
      if (!column->empty() && !std::isnan(value)) column->back() = value;
    joined_ += any;
    return any;
  }

  void note(const std::string& column, unsigned bit) {
    if ((noted_ & (1u << bit)) != 0) return;
    noted_ |= 1u << bit;
    table_.blanks.push_back({row_.line(), column, row_.text_of(column)});
  }

  CsvRow& row_;
  RecordedRows& table_;
  unsigned noted_ = 0;
  long joined_ = 0;
};

/// What stands in the first line of a text in which no rows are seen.
std::vector<std::string> first_names(const std::string& path) {
  TextLines lines(path);
  std::vector<std::string_view> fields, most;
  for (std::string_view line; most.empty() && lines.next(line);) {
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    for (const char separator : {',', ';', '\t'}) {
      split_fields(line, separator, fields);
      if (fields.size() > most.size()) most = fields;
    }
  }
  return {most.begin(), most.end()};
}

}  // namespace

std::vector<std::string> csv_names(const std::string& path) {
  const TableForm form = table_of(path);
  if (form.first == 0) return first_names(path);
  std::vector<std::string> names = form.names;
  for (std::size_t i = 0; !form.rows.empty() && i < std::min(form.names.size(), form.rows.front().size());
       ++i) {
    const std::string& field = form.rows.front()[i];
    if (kind_of_field(field) != FieldKind::kList) continue;
    std::vector<std::string_view> elements;
    split_fields(std::string_view(field).substr(1, field.size() - 2), ',', elements);
    for (std::size_t j = 0; j < elements.size(); ++j)
      names.push_back(form.names[i] + "[:, " + std::to_string(j) + "]");
  }
  return names;
}

RecordedRows read_csv(const std::string& path, const RecordingColumns& columns, EarlierRow earlier) {
  RecordedRows table;
  table.path = path;
  TableForm form = table_of(path);
  table.assumed = form.told;
  CsvRow row(path, columns, std::move(form));
  table.newest_first = row.newest_first();
  RowTaker taker(row, table);
  TextLines lines(path);
  std::optional<ConfigError> behind;  // of the first line that is no row, below all rows
  for (std::string_view line; lines.next(line);) {
    table.open_end = lines.open_end();
    const std::size_t rows = table.size();
    try {
      if (!row.next(line)) continue;
      if (behind) throw *behind;  // there are rows below it
      taker.add(earlier);
    } catch (const ConfigError& problem) {
      if (table.size() != rows || table.line.size() != rows || !row.begins_with_text()) throw;
      if (!behind) behind = problem;
    }
  }
  if (behind && table.size() < kFewestSamples) throw *behind;
  if (behind) table.assumed.emplace_back("table.lines_behind", "lines behind it");
  if (taker.joined() > 0)
    table.assumed.emplace_back("table.joined", "rows of one time joined: {}",
                               std::vector<Remark::Value>{taker.joined()});
  row.require_header();
  table.has_input = row.has_input();
  if (table.newest_first) {
    table.reverse();
    table.assumed.emplace_back("table.newest_first", "newest row first: turned round");
  }
  if (row.reads_clock() && table.size() > 0) {
    table.shift_time(-table.t.front());
    table.assumed.emplace_back("table.clock", "times of a clock, counted from the first row on");
  }
  settle_blanks(table);
  return table;
}

}  // namespace gapscope::internal::recording
