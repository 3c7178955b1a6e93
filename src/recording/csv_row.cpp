#include "recording/csv_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "gapscope/base/statistics.h"
#include "recording/limits.h"

namespace gapscope::internal::recording {
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

/// Where a comment begins: at a `#` outside quotes that begins the line or follows a blank. Others are part
/// of what they stand in, as in Microsoft's 1.#QNAN.
bool begins_comment(std::string_view text, std::size_t at) {
  return text[at] == '#' && (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t');
}

/// Whether a column may be meant by a name: "x1 [rad]" or "X1" by "x1".
bool may_be_meant(std::string_view column, std::string_view name) {
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  if (column.size() < name.size() || (column.size() > name.size() && letter(column[name.size()])))
    return false;
  return std::equal(name.begin(), name.end(), column.begin(),
                    [&](char a, char b) { return lower(a) == lower(b); });
}

/// Whether fields may be names of columns: several, with no sign that stands in settings, keys and code.
bool are_names(const std::vector<std::string_view>& fields) {
  return fields.size() > 1 && std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
           return field.find_first_of(":=;{}<>$!@&*\\`\"'") == field.npos;
         });
}

/// What a line is that is no header at all; empty where it may be one.
std::string no_header(std::string_view line, const std::vector<std::string_view>& fields) {
  if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF")) return "is text in UTF-16";
  while (line.ends_with('\r')) line.remove_suffix(1);
  if (line.find('\r') != line.npos) return "ends its lines with carriage returns alone";
  const auto is_control = [](char c) { return c != '\t' && static_cast<unsigned char>(c) < 0x20; };
  if (std::any_of(line.begin(), line.end(), is_control)) return "is no text";
  const auto is_number = [](std::string_view field) {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(field.data(), field.data() + field.size(), value);
    return problem == std::errc() && end == field.data() + field.size();
  };
  if (std::all_of(fields.begin(), fields.end(), is_number)) return "begins with numbers";
  return "";
}

}  // namespace

void split_fields(std::string_view text, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0, end = 0;
  bool quoted = false;
  for (; end < text.size() && (quoted || !begins_comment(text, end)); ++end) {
    if (text[end] == '"') quoted = !quoted;
    if (text[end] != separator || quoted) continue;
    fields.push_back(unquoted(trimmed(text.substr(begin, end - begin))));
    begin = end + 1;
  }
  const std::string_view last = trimmed(text.substr(begin, end - begin));
  if (!last.empty() || !fields.empty()) fields.push_back(unquoted(last));
}

bool CsvRow::next(std::string_view line) {
  if (++line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  split_fields(line, separator_, fields_);
  const auto is_empty = [](std::string_view field) { return field.empty(); };
  if (std::all_of(fields_.begin(), fields_.end(), is_empty))
    return false;  // separators alone, as below a sheet
  if (has_header_) check_width();
  if (has_header_) return true;
  header(line);
  return false;
}

void CsvRow::require_header() const {
  if (!has_header_) throw ConfigError(name_, "is empty, expected a header with " + wanted());
}

void CsvRow::fail(const std::string& what) const { throw ConfigError(name_, line_, what); }

std::string CsvRow::wanted() const {
  return fmt::format("the columns {}, {}, {}", columns_.time,
                     columns_.reads_input() ? columns_.input : columns_.target, columns_.position);
}

/// The header as it is, its first columns; nothing of a line that may be none, whoever's file that is.
std::string CsvRow::there() const {
  constexpr std::size_t kMost = 6;
  if (!knows_one_ && !are_names(fields_)) return "in the first line";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(kMost, fields_.size()); ++i) names.push_back(shown(fields_[i]));
  return fmt::format("among {}{}", fmt::join(names, ", "), fields_.size() > kMost ? ", ..." : "");
}

/// How the name of a missing column is declared: of the one alone where the two others are there.
std::string CsvRow::how_declared(const std::string& name) const {
  const std::pair<const char*, const std::string*> three[] = {
      {"time", &columns_.time}, {"input", &columns_.input}, {"position", &columns_.position}};
  const auto missing = [&](const auto& column) {
    return std::ranges::find(fields_, *column.second) == fields_.end();
  };
  if (std::ranges::count_if(three, missing) == 1)
    for (const auto& [role, column] : three)
      if (*column == name) return fmt::format("recording: columns: {0}, or --{0}", role);
  return "recording: columns, or --time, --input, --position";
}

/// Place of a column in the header; -1 if it is not there and need not be.
int CsvRow::place(const std::string& name, bool required) const {
  const auto found = std::find(fields_.begin(), fields_.end(), name);
  if (found == fields_.end()) {
    if (!required) return -1;
    const auto meant = std::find_if(fields_.begin(), fields_.end(),
                                    [&](std::string_view column) { return may_be_meant(column, name); });
    const bool of_motor = meant == fields_.end() && name == "x2" && name == columns_.position &&
                          std::find(fields_.begin(), fields_.end(), "x1") != fields_.end();
    fail(fmt::format("there is no column {} {}, expected a header with {}; other names{} are declared ({})",
                     shown(name), there(), wanted_with(name),
                     of_motor                 ? ", perhaps x1 here (--position x1),"
                     : meant == fields_.end() ? ""
                                              : fmt::format(", perhaps {} here,", shown(*meant)),
                     how_declared(name)));
  }
  if (std::find(found + 1, fields_.end(), name) != fields_.end())
    fail(fmt::format("the column {} is there twice, expected it once", shown(name)));
  return static_cast<int>(found - fields_.begin());
}

std::string CsvRow::wanted_with(const std::string& name) const {
  const bool one_of_three = name == columns_.position;  // of an encoder on the load alone
  const bool further = !one_of_three && (name == columns_.load_position || name == columns_.voltage ||
                                         (name == columns_.target && columns_.reads_input()));
  return further ? wanted() + ", " + name : wanted();
}

/// The separator is the one with which most of the columns that are looked for are there; the comma before
/// others.
void CsvRow::header(std::string_view line) {
  has_header_ = true;
  std::pair<std::ptrdiff_t, bool> most = {-1, false};
  for (const char separator : {',', ';', '\t'}) {
    std::vector<std::string_view> fields;
    split_fields(line, separator, fields);
    const auto found = std::count_if(fields.begin(), fields.end(), [&](std::string_view name) {
      return name == columns_.time || name == (columns_.reads_input() ? columns_.input : columns_.target) ||
             name == columns_.position;
    });
    const std::pair<std::ptrdiff_t, bool> rank = {found, fields.size() > 1};
    if (rank > most) most = rank, separator_ = separator, fields_ = std::move(fields);
  }
  while (fields_.size() > 1 && fields_.back().empty()) fields_.pop_back();
  if (const std::string what = no_header(line, fields_); most.first < 3 && !what.empty())
    fail(what + ", expected a CSV in UTF-8 that begins with a header with " + wanted());
  width_ = fields_.size(), knows_one_ = most.first > 0;
  t_ = place(columns_.time, true);
  if (columns_.reads_input()) u_ = place(columns_.input, columns_.input_column == InputColumn::kRequired);
  x1_ = place(columns_.position, true);
  x2_ = place(columns_.load_position, columns_.load_position_required);
  if (!columns_.voltage.empty() && (u_ >= 0 || !columns_.target.empty()))
    voltage_ = place(columns_.voltage, true);
  if (!columns_.target.empty()) target_ = place(columns_.target, true);
}

/// More fields than the header are fine while they are empty (a trailing comma); decimal commas are not,
/// where commas separate the columns.
void CsvRow::check_width() const {
  std::size_t filled = fields_.size();
  while (filled > width_ && fields_[filled - 1].empty()) --filled;
  if (filled < width_ || filled > width_)
    fail(fmt::format("{} fields, expected {} as in the header{}", filled, width_,
                     separator_ == ',' && filled > width_
                         ? " (numbers with a decimal comma need ; or a tab between the columns)"
                         : ""));
}

/// A number as it is read: with a point. A comma is a decimal mark where it separates no columns.
std::string_view CsvRow::with_decimal_point(std::string_view text, const std::string& column) {
  const auto mark = separator_ == ',' ? text.npos : text.find_first_of(".,");
  if (mark == text.npos) return text;
  if (decimal_mark_ == 0) decimal_mark_ = text[mark];
  if (text[mark] != decimal_mark_ || text.find_first_of(".,", mark + 1) != text.npos)
    fail(fmt::format("{} is {}, expected one decimal mark, {} as in the number before", column, shown(text),
                     decimal_mark_ == ',' ? "a comma" : "a point"));
  if (decimal_mark_ == '.') return text;
  text_ = text;
  text_[mark] = '.';
  return text_;
}

double CsvRow::input() {
  if (u_ < 0) return kNaN;
  const double u = number(u_, columns_.input, columns_.scales.input);
  return voltage_ < 0 ? u : u * supply();
}

double CsvRow::supply() {
  return voltage_ < 0 ? 1.0 : number(voltage_, columns_.voltage, columns_.scales.voltage);
}

double CsvRow::number(int place, const std::string& column, const UnitScale& scale) {
  std::string_view text = with_decimal_point(fields_[static_cast<std::size_t>(place)], column);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size() && !text.empty();
  value = scale(value);
  if (whole && problem == std::errc() && std::abs(value) <= kLargestNumber) return value;
  const bool vanishes = std::abs(std::strtod(std::string(text).c_str(), nullptr)) < 1.0;
  if (whole && problem == std::errc::result_out_of_range && vanishes) return 0.0;
  const bool too_large = whole && problem == std::errc() && std::isfinite(value);
  fail(fmt::format(
      "{} is {}, expected {}", column, text.empty() ? "empty" : shown(text),
      too_large ? fmt::format("at most {:g} in size{}", kLargestNumber,
                              column == columns_.time ? "; a time in ns is declared (--time-unit ns)" : "")
                : "a finite number"));
}

}  // namespace gapscope::internal::recording
