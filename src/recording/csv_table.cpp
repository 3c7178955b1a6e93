#include "recording/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "gapscope/base/errors.h"
#include "recording/limits.h"

namespace gapscope::internal {
namespace {

std::string_view trimmed(std::string_view text) {
  const char* const blanks = " \t\r\v\f";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view unquoted(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    return trimmed(field.substr(1, field.size() - 2));
  return field;
}

/// Splits at commas outside quotes; a `#` outside quotes ends the line. The vector is reused: no allocation
/// per row. A line with nothing but blanks and comment gives no field.
void split(std::string_view text, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0, end = 0;
  bool quoted = false;
  for (; end < text.size() && (quoted || text[end] != '#'); ++end) {
    if (text[end] == '"') quoted = !quoted;
    if (text[end] != ',' || quoted) continue;
    fields.push_back(unquoted(trimmed(text.substr(begin, end - begin))));
    begin = end + 1;
  }
  const std::string_view last = trimmed(text.substr(begin, end - begin));
  if (!last.empty() || !fields.empty()) fields.push_back(unquoted(last));
}

std::string whole_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::file_status status = fs::status(path, problem);
  if (!fs::exists(status)) throw ConfigError(path, "there is no such file, expected a recording as CSV");
  if (!fs::is_regular_file(status))
    throw ConfigError(path, "is no regular file, expected a recording as CSV");
  const std::uintmax_t bytes = fs::file_size(path);
  if (bytes > kMostBytes)
    throw ConfigError(path, fmt::format("has {:.3g} bytes, expected at most {:.3g}",
                                        static_cast<double>(bytes), static_cast<double>(kMostBytes)));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigError(path, "cannot be opened, expected a readable file");
  std::string text(static_cast<std::size_t>(bytes), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw ConfigError(path, "cannot be read, expected a readable file");
  return text;
}

/// Reads the lines of one file into a table.
class TableReader {
 public:
  TableReader(const std::string& path, const CsvColumns& columns, EarlierRow earlier)
      : columns_(columns), earlier_(earlier) {
    table_.path = path;
  }

  CsvTable read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      ++line_;
      split(text.substr(0, end), fields_);
      if (!fields_.empty()) has_header_ ? row() : header();
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!has_header_) throw ConfigError(table_.path, "is empty, expected a header with " + wanted());
    return std::move(table_);
  }

 private:
  std::string wanted() const {
    return fmt::format("the columns {}, {}, {}", columns_.time, columns_.input, columns_.position);
  }

  /// Place of a column in the header; -1 if it is not there and need not be.
  int place(const std::string& name, bool required) const {
    const auto found = std::find(fields_.begin(), fields_.end(), name);
    if (found == fields_.end()) {
      if (!required) return -1;
      fail(fmt::format("there is no column {}, expected a header with {}", shown(name), wanted_with(name)));
    }
    if (std::find(found + 1, fields_.end(), name) != fields_.end())
      fail(fmt::format("the column {} is there twice, expected it once", shown(name)));
    return static_cast<int>(found - fields_.begin());
  }

  std::string wanted_with(const std::string& name) const {
    return name == columns_.load_position ? wanted() + ", " + name : wanted();
  }

  void header() {
    has_header_ = true;
    while (fields_.size() > 1 && fields_.back().empty()) fields_.pop_back();
    width_ = fields_.size();
    t_ = place(columns_.time, true);
    u_ = place(columns_.input, true);
    x1_ = place(columns_.position, true);
    x2_ = place(columns_.load_position, columns_.load_position_required);
  }

  void row() {
    check_width();
    const double t = number(t_, columns_.time);
    const bool goes_on = table_.t.empty() || t > table_.t.back();
    if (!goes_on && earlier_ == EarlierRow::kSkipped) return table_.skipped.push_back(line_);
    if (!goes_on)
      fail(fmt::format("{} goes from {} to {} s, expected time that increases from row to row", columns_.time,
                       table_.t.back(), t));
    if (table_.size() == kMostSamples)
      fail(fmt::format("more than {} rows, expected at most that many", kMostSamples));
    table_.t.push_back(t);
    table_.u.push_back(number(u_, columns_.input));
    table_.x1.push_back(number(x1_, columns_.position));
    if (x2_ >= 0) table_.x2.push_back(number(x2_, columns_.load_position));
    table_.line.push_back(line_);
  }

  /// More fields than the header are fine while they are empty (a trailing comma); decimal commas are not.
  void check_width() const {
    std::size_t filled = fields_.size();
    while (filled > width_ && fields_[filled - 1].empty()) --filled;
    if (filled < width_ || filled > width_)
      fail(fmt::format("{} fields, expected {} as in the header", filled, width_));
  }

  double number(int place, const std::string& column) const {
    std::string_view text = fields_[static_cast<std::size_t>(place)];
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end == text.data() + text.size() && !text.empty();
    if (whole && problem == std::errc() && std::isfinite(value)) return value;
    const bool vanishes = text.find("e-") != text.npos || text.find("E-") != text.npos;
    if (whole && problem == std::errc::result_out_of_range && vanishes) return 0.0;
    fail(fmt::format("{} is {}, expected a finite number", column, text.empty() ? "empty" : shown(text)));
  }

  [[noreturn]] void fail(const std::string& what) const { throw ConfigError(table_.path, line_, what); }

  const CsvColumns& columns_;
  const EarlierRow earlier_;
  CsvTable table_;
  std::vector<std::string_view> fields_;
  std::size_t width_ = 0;
  int line_ = 0, t_ = -1, u_ = -1, x1_ = -1, x2_ = -1;
  bool has_header_ = false;
};

template <class T>
void keep_part(std::vector<T>& values, std::size_t first, std::size_t count) {
  if (values.empty()) return;
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  values = std::vector<T>(begin, begin + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

void CsvTable::keep(std::size_t first, std::size_t count) {
  for (auto* column : {&t, &u, &x1, &x2}) keep_part(*column, first, count);
  keep_part(line, first, count);
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string out(text.substr(0, kMost));
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + out + (text.size() > kMost ? "...'" : "'");
}

CsvTable read_table(const std::string& path, const CsvColumns& columns, EarlierRow earlier) {
  const std::string text = whole_file(path);
  return TableReader(path, columns, earlier).read(text);
}

}  // namespace gapscope::internal
