#include "recording/csv_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/array_file.h"
#include "recording/limits.h"

namespace gapscope::internal::recording {
namespace {

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
bool are_names(const std::vector<std::string>& fields) {
  return fields.size() > 1 && std::all_of(fields.begin(), fields.end(), [](const std::string& field) {
           return field.find_first_of(":=;{}<>$!@&*\\`\"'") == field.npos;
         });
}

/// What a line is that is no header at all; empty where it may be one.
std::string no_header(std::string_view line, const std::vector<std::string_view>& fields) {
  if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF"))
    return "is text in UTF-16 (iconv -f UTF-16 -t UTF-8 FILE)";
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

bool CsvRow::next(std::string_view line) {
  if (++line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  if (form_.first > 0 && !has_header_) settle_columns();
  if (line_ < form_.first || line.starts_with('%') || line.starts_with("//")) return false;
  split_fields(line, form_.separator, fields_);
  const auto is_empty = [](std::string_view field) { return field.empty(); };
  if (std::all_of(fields_.begin(), fields_.end(), is_empty))
    return false;  // separators alone, as below a sheet
  if (!has_header_) {
    header(line);
    return false;
  }
  if (rows_ == 0 && are_units(fields_)) return false;
  check_width();
  ++rows_;
  return true;
}

bool CsvRow::newest_first() {
  if (form_.first == 0 || columns_.rate > 0.0) return false;
  if (!has_header_) settle_columns();
  std::size_t falls = 0, rises = 0;
  double before = kNaN;
  for (const auto& row : form_.rows) {
    fields_.assign(row.begin(), row.end());
    double now = kNaN;
    try {
      now = time();
    } catch (const ConfigError&) {
      continue;  // told where it is read
    }
    falls += now < before, rises += now >= before;
    if (!std::isnan(now)) before = now;
  }
  clock_ = {};
  fields_.clear();
  return falls > 2 && rises == 0;
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
  const std::vector<std::string>& all = form_.names;
  if (!knows_one_ && !are_names(all)) return line_ == 1 ? "in the first line" : "in that line";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i) names.push_back(shown(all[i]));
  return fmt::format("among {}{}", fmt::join(names, ", "), all.size() > kMost ? ", ..." : "");
}

/// How the name of a missing column is declared: of the one alone where the two others are there.
std::string CsvRow::how_declared(const std::string& name) const {
  const std::pair<const char*, const std::string*> three[] = {
      {"time", &columns_.time}, {"input", &columns_.input}, {"position", &columns_.position}};
  const auto missing = [&](const auto& column) { return column_of(*column.second) < 0; };
  if (std::ranges::count_if(three, missing) == 1)
    for (const auto& [role, column] : three)
      if (*column == name) return fmt::format("recording: columns: {0}, or --{0}", role);
  return "recording: columns, or --time, --input, --position";
}

/// Of the column of that name, or else at that place, counted from 1; -1: there is none.
int CsvRow::column_of(const std::string& name) const {
  const auto& names = form_.names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  int at = 0;
  const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), at);
  const bool is_place = problem == std::errc() && end == name.data() + name.size();
  return is_place && at >= 1 && at <= static_cast<int>(width_) ? at - 1 : -1;
}

/// Whether two columns have the same fields in the first rows.
bool CsvRow::same_times(std::size_t a, std::size_t b) const {
  return !form_.rows.empty() && std::all_of(form_.rows.begin(), form_.rows.end(), [&](const auto& row) {
    return a < row.size() && b < row.size() && row[a] == row[b];
  });
}

/// In the header; nowhere if it is not there and need not be.
CsvRow::Place CsvRow::place(const std::string& name, bool required) const {
  const auto& names = form_.names;
  int column = column_of(name), element = -1;
  if (const auto part = column < 0 ? table_column(name) : std::nullopt) {
    column = column_of(part->table);
    element = static_cast<int>(std::min<std::size_t>(part->index, kMostSamples));
  }
  if (column < 0) {
    if (!required) return {};
    const auto meant = std::find_if(names.begin(), names.end(),
                                    [&](std::string_view known) { return may_be_meant(known, name); });
    const bool of_motor = meant == names.end() && name == "x2" && name == columns_.position &&
                          std::find(names.begin(), names.end(), "x1") != names.end();
    fail(fmt::format("there is no column {} {}, expected a header with {}; other names{} are declared ({})",
                     shown(name), there(), wanted_with(name),
                     of_motor               ? ", perhaps x1 here (--position x1),"
                     : meant == names.end() ? ""
                                            : fmt::format(", perhaps {} here,", shown(*meant)),
                     how_declared(name)));
  }
  const auto again = std::find(names.begin() + column + 1, names.end(), name);
  if (again == names.end()) return {column, element};
  const auto second = static_cast<std::size_t>(again - names.begin());
  if (name == columns_.time && same_times(static_cast<std::size_t>(column), second)) return {column, element};
  fail(fmt::format("the column {} is there twice, expected it once, or its place from 1 on ({} or {})",
                   shown(name), column + 1, second + 1));
}

/// A date without a clock stands beside the column of the clock.
CsvRow::Place CsvRow::place_of_time() const {
  const Place named = place(columns_.time, true);
  if (form_.rows.empty()) return named;
  const auto& row = form_.rows.front();
  const auto is_stamp = [&](std::size_t i) {
    return i < row.size() && kind_of_field(row[i]) == FieldKind::kStamp;
  };
  const auto at = static_cast<std::size_t>(named.column);
  if (!is_stamp(at) || RowClock::reads(row[at])) return named;
  for (const std::size_t beside : {at + 1, at - 1})
    if (is_stamp(beside) && RowClock::reads(row[beside])) return {static_cast<int>(beside)};
  return named;
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
  std::pair<std::ptrdiff_t, bool> most = {-1, false};
  for (const char separator : {',', ';', '\t'}) {
    std::vector<std::string_view> fields;
    split_fields(line, separator, fields);
    const auto found = std::count_if(fields.begin(), fields.end(), [&](std::string_view name) {
      return name == columns_.time || name == (columns_.reads_input() ? columns_.input : columns_.target) ||
             name == columns_.position;
    });
    const std::pair<std::ptrdiff_t, bool> rank = {found, fields.size() > 1};
    if (rank > most) most = rank, form_.separator = separator, fields_ = std::move(fields);
  }
  while (fields_.size() > 1 && fields_.back().empty()) fields_.pop_back();
  if (const std::string what = no_header(line, fields_); most.first < 3 && !what.empty())
    fail(what + ", expected a CSV in UTF-8 that begins with a header with " + wanted());
  form_.names.assign(fields_.begin(), fields_.end());
  form_.header = form_.first = line_;
  settle_columns();
}

void CsvRow::settle_columns() {
  has_header_ = true;
  const std::int64_t line = std::exchange(line_, form_.header > 0 ? form_.header : form_.first);
  const auto& names = form_.names;
  width_ = names.size();
  for (const std::string* name : {&columns_.time, &columns_.input, &columns_.target, &columns_.position})
    knows_one_ = knows_one_ || std::find(names.begin(), names.end(), *name) != names.end();
  if (form_.header == 0 && column_of(columns_.position) < 0)
    fail(fmt::format(
        "begins with numbers, expected a CSV in UTF-8 that begins with a header with {}, or the places "
        "of these columns (--columns 1,2,3)",
        wanted()));
  if (columns_.rate == 0.0) t_ = place_of_time();
  if (columns_.reads_input()) u_ = place(columns_.input, columns_.input_column == InputColumn::kRequired);
  x1_ = place(columns_.position, true);
  if (!columns_.position_is_speed) x2_ = place(columns_.load_position, columns_.load_position_required);
  if (!columns_.voltage.empty() && (has_input() || !columns_.target.empty()))
    voltage_ = place(columns_.voltage, true);
  if (!columns_.target.empty()) target_ = place(columns_.target, true);
  line_ = line;
}

/// More fields than the header are fine while they are empty (a trailing comma); decimal commas are not,
/// where commas separate the columns.
void CsvRow::check_width() const {
  std::size_t filled = fields_.size();
  while (filled > width_ && fields_[filled - 1].empty()) --filled;
  if (filled < width_ || filled > width_)
    fail(fmt::format("{} fields, expected {} as in the header{}", filled, width_,
                     form_.separator == ',' && filled > width_
                         ? " (numbers with a decimal comma need ; or a tab between the columns)"
                         : ""));
}

/// A number as it is read: with a point. A comma is a decimal mark where it separates no columns, or in
/// quotes.
std::string_view CsvRow::with_decimal_point(std::string_view text, const std::string& column) {
  const auto mark = text.find_first_of(".,");
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

double CsvRow::time() {
  if (columns_.rate > 0.0) return static_cast<double>(rows_ - 1) / columns_.rate;
  const std::string_view text = field(t_, columns_.time);
  const UnitScale& scale = columns_.scales.time;
  if (!RowClock::reads(text)) return number(t_, columns_.time, scale);
  const double unit = scale.factor / scale.divisor;
  const bool too_large =
      text.find(':') == text.npos && std::abs(std::atof(std::string(text).c_str()) * unit) > kLargestNumber;
  const auto seconds = too_large ? std::nullopt : clock_.seconds(text, unit);
  return seconds ? *seconds : slow_number(text, columns_.time, scale);
}

double CsvRow::input() {
  if (!has_input()) return kNaN;
  const double u = number(u_, columns_.input, columns_.scales.input);
  return voltage_.column < 0 ? u : u * supply();
}

double CsvRow::supply() {
  return voltage_.column < 0 ? 1.0 : number(voltage_, columns_.voltage, columns_.scales.voltage);
}

/// The text of a number; of a list that of its element.
std::string_view CsvRow::field(Place place, const std::string& column) const {
  std::string_view text = fields_[place.column];
  if (!text.starts_with('[') || !text.ends_with(']')) return text;
  text = text.substr(1, text.size() - 2);
  std::vector<std::string_view> elements;
  for (const char separator : {',', ';', kBlanks}) {
    split_fields(text, separator, elements);
    if (elements.size() > 1) break;
  }
  const auto at = static_cast<std::size_t>(std::max(place.element, 0));
  if (at < elements.size() && (place.element >= 0 || elements.size() == 1)) return elements[at];
  fail(fmt::format("{} is a list of {}, expected one of its elements by name ({}[:, 0])", column,
                   elements.size(), column.substr(0, column.find('['))));
}

std::string CsvRow::text_of(const std::string& column) const {
  const int at = column_of(column);
  return at < 0 || at >= static_cast<int>(fields_.size()) ? "" : std::string(fields_[at]);
}

bool CsvRow::begins_with_text() const {
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
  return has_header_ && rows_ > 0 && !fields_.empty() && kind_of_field(fields_.front()) == FieldKind::kText &&
         std::any_of(fields_.front().begin(), fields_.front().end(), is_letter);
}

double CsvRow::number(Place place, const std::string& column, const UnitScale& scale) {
  std::string_view text = fields_[place.column];
  if (text.starts_with('[')) text = field(place, column);
  if (form_.separator != ',') text = with_decimal_point(text, column);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  value = scale(value);
  if (problem == std::errc() && end == text.data() + text.size() && std::abs(value) <= kLargestNumber)
    return value;
  // Between commas one within a number is rare: it is in quotes.
  if (form_.separator == ',' && text.find(',') != text.npos) text = with_decimal_point(text, column);
  return slow_number(text, column, scale);
}

/// Of a text that is no number as it stands.
double CsvRow::slow_number(std::string_view text, const std::string& column, const UnitScale& scale) const {
  if (is_blank_field(text)) return kNaN;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  value = scale(value);
  if (whole && problem == std::errc() && std::abs(value) <= kLargestNumber) return value;
  const bool vanishes = std::abs(std::strtod(std::string(text).c_str(), nullptr)) < 1.0;
  if (whole && problem == std::errc::result_out_of_range && vanishes) return 0.0;
  const bool too_large = whole && problem == std::errc() && std::isfinite(value);
  fail(fmt::format(
      "{} is {}, expected {}", column, shown(text),
      too_large ? fmt::format("at most {:g} in size{}", kLargestNumber,
                              column == columns_.time ? "; a time in ns is declared (--time-unit ns)" : "")
                : "a finite number"));
}

}  // namespace gapscope::internal::recording
